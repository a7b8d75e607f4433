// Chapters with a state of the page that shows them in motion: text of the link, and address within the page.
export const STATES = {
  'docs/tutorials/first-ripples.md': ['The tip of this chapter sticks and slips', '#alpha=1.2&r=1'],
  'docs/explanation/equation.md': ['A tip in its groove', '#alpha=0.9&r=1&kick=0.5&until=100'],
  'docs/explanation/linear-theory.md': ['A small kick grows just above αc', '#alpha=1.08&r=1&until=457'],
  'docs/explanation/trapping.md': ['A tip that gets stuck', '#alpha=3.5&r=1&kick=0.1&until=400'],
  'docs/explanation/cycles.md': ['A cycle of period two', '#alpha=1.62&r=1&kick=0.1&until=400'],
  'docs/explanation/rasters.md': ['Ripples grow from line to line', '#alpha=0.9&r=1&beta=0&kick=0.1&show=rasters'],
  'docs/explanation/across.md': ['A line that snakes', '#alpha=0.9&r=1&stiffness_across=0.25&kick=0&until=600&show=charts'],
  'docs/explanation/wider-law.md': ['A tip with a depth limit', '#alpha=2&r=1&depth_limit=5&kick=0.2'],
  'docs/explanation/regimes.md': ['The map of regimes', '#alpha=1.62&r=1&show=phases'],
  'docs/explanation/walkers.md': ['A walker on a circle', '#alpha=1.2&r=1&walker_rotation=0.3&show=walkers'],
};
