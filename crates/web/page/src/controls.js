// Sliders, each with a field for any number.
import { read } from './parameters.js';

const parts = 1000;
const digits = (value, most = 10) => String(Number(value.toPrecision(most)));

/** The conversion between a value and the place of the slider. */
function scale({ min, max, step, log, digits: kept = 3 }) {
  if (!log) return { min, max, step, place: (v) => v, value: (p) => Number(p.toFixed(10)) };
  const ratio = Math.log(max / min);
  return {
    min: 0,
    max: parts,
    step: 1,
    place: (v) => (parts * Math.log(v / min)) / ratio,
    value: (p) => Number((min * Math.exp((ratio * p) / parts)).toPrecision(kept)),
  };
}

/** Rows of sliders in `host`. `changed(name, value)` is called with a number, or null for an absent one. */
export function sliders(host, list, changed) {
  const rows = Object.fromEntries(list.map((slider) => [slider.name, row(host, slider, changed)]));
  return {
    show(values) {
      for (const slider of list) rows[slider.name].show(values[slider.name]);
    },
    refuse(name, why) {
      rows[name]?.refuse(why);
    },
  };
}

function row(host, slider, changed) {
  const { name, sign, label, unit, optional, description } = slider;
  const { min, max, step, place, value } = scale(slider);
  const box = document.createElement('div');
  box.className = 'row';
  box.innerHTML = `
    <label for="${name}"><i>${sign.replace(/_(.)/, '<sub>$1</sub>')}</i> ${label}${unit ? `, ${unit}` : ''}</label>
    ${optional ? `<label class="there"><input type="checkbox" id="${name}-there"> on</label>` : ''}
    <input type="text" inputmode="decimal" id="${name}-number" aria-label="${label}, ${sign}: number"
      aria-describedby="${name}-why" autocomplete="off" spellcheck="false">
    <input type="range" id="${name}" min="${min}" max="${max}" step="${step}">
    <p class="why" id="${name}-why" hidden></p>`;
  if (description) box.title = description;
  host.append(box);
  const at = (id) => box.querySelector(`#${id}`);
  const [range, field, there, why] = [at(name), at(`${name}-number`), at(`${name}-there`), at(`${name}-why`)];
  let last = slider.usual;

  const refuse = (message) => {
    why.hidden = !message;
    why.textContent = message ?? '';
    field.setAttribute('aria-invalid', message ? 'true' : 'false');
  };
  const show = (number) => {
    refuse(null);
    const absent = number === null;
    if (!absent) last = number;
    range.disabled = field.disabled = absent;
    if (there) there.checked = !absent;
    range.value = place(last);
    field.value = absent ? 'none' : digits(last, 15);
    range.setAttribute('aria-valuetext', absent ? 'none' : `${sign} = ${digits(last, 6)}`);
  };
  range.addEventListener('input', () => {
    const number = value(Number(range.value));
    show(number);
    changed(name, number);
  });
  field.addEventListener('input', () => {
    const number = read(name, field.value);
    if (number === undefined) return refuse(`“${field.value}” is not a number for ${sign}`);
    refuse(null);
    if (number !== null) {
      last = number;
      range.value = place(number);
    }
    changed(name, number);
  });
  there?.addEventListener('change', () => {
    show(there.checked ? last : null);
    changed(name, there.checked ? last : null);
  });
  return { show, refuse };
}
