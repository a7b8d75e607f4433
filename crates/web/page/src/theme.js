// Light or dark colours: those of the system, or a choice.

const THEMES = ['auto', 'light', 'dark'];

/** Colours of the style sheet; reading one takes as long as drawing. */
const known = new Map();

export function colour(name) {
  if (!known.has(name)) known.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return known.get(name);
}

export function theme(button, changed) {
  const show = (name) => {
    if (name === 'auto') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = name;
    button.textContent = `Colours: ${name}`;
  };
  const fresh = () => {
    known.clear();
    changed();
  };
  let chosen = 'auto';
  show(chosen);
  button.addEventListener('click', () => {
    chosen = THEMES[(THEMES.indexOf(chosen) + 1) % THEMES.length];
    show(chosen);
    fresh();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', fresh);
}

/** A canvas as sharp as the screen, and its size in page units. */
export function sharp(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
  const pen = canvas.getContext('2d');
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}
