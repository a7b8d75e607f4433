// The tour: five states of the page in order, each with a link and one sentence.
import { TOUR } from './presets.js';
import { address } from './parameters.js';

export const steps = TOUR.map((step) => ({ ...step, link: address(step.state) }));

export function tour({ list, text, next }) {
  list.innerHTML = steps.map(({ name, link }) => `<li><a href="${link.replaceAll('&', '&amp;')}">${name}</a></li>`).join('');
  const links = list.querySelectorAll('a');
  return {
    /** Marks the step with this address, if there is one. */
    at(hash) {
      const n = steps.findIndex(({ link }) => link === hash);
      if (n < 0) return;
      links.forEach((link, i) => (i === n ? link.setAttribute('aria-current', 'step') : link.removeAttribute('aria-current')));
      text.textContent = `${n + 1} of ${steps.length}: ${steps[n].text}`;
      next.hidden = n === steps.length - 1;
      if (!next.hidden) next.href = steps[n + 1].link;
    },
    begin: () => (next.href = steps[0].link),
  };
}
