// Results of theory and of the run, in numbers and in words.

const digits = (value, n = 10) => (value === null || value === undefined ? '–' : String(Number(value.toPrecision(n))).replace('-', '−'));
/** A number as the program prints it: its reliable digits, with the error of the last one in parentheses. */
function reliable(value, error) {
  if (!(error > 0)) return digits(value, 12);
  const place = (size) => Math.floor(Math.log10(Math.max(Math.abs(size), 1e-300)));
  let last = Math.max(place(error), place(value) - 14);
  if (Math.ceil(error / 10 ** last + 0.5) >= 10) last += 1;
  return `${value.toFixed(Math.max(0, -last))}(${Math.ceil(error / 10 ** last + 0.5)})`;
}
const complex = ({ re, im }) => (im === 0 ? digits(re, 6) : `${digits(re, 6)} ${im < 0 ? '−' : '+'} ${digits(Math.abs(im), 6)} i`);
/** One number of each conjugate pair, with ±. */
const upper = (list) => list.filter(({ im }) => im >= 0).map((z) => (z.im === 0 ? digits(z.re, 6) : complex(z).replace('+', '±')));

const UNITS = { period: 'Γ/k', wavelength: 'σ', amplitude: 'σ' };

export function facts(host) {
  const cell = (id) => host.querySelector(`#${id}`);
  const put = (id, text, value) => {
    cell(id).textContent = text;
    if (value !== undefined) cell(id).dataset.value = JSON.stringify(value);
    else delete cell(id).dataset.value;
  };
  const known = (id, value, error, unit) => (value == null ? put(id, '–') : put(id, `${reliable(value, error)} ${unit}`, value));
  const number = (id, value, unit = '') => put(id, `${digits(value)} ${value == null ? '' : unit}`.trim(), value);

  return {
    linear({ found, why }) {
      if (!found) return put('fact-stable', why);
      number('fact-critical', found.critical?.alpha);
      if (!found.critical) put('fact-critical', 'none: steady motion has no onset here');
      number('fact-snaking', found.snaking?.alpha);
      number('fact-omega', found.critical?.omega, 'k/Γ');
      number('fact-trapping', found.trapping);
      number('fact-steady', found.steady?.l, 'σ');
      put('fact-stable', found.stable === null ? 'no linear law decides' : found.stable ? 'yes' : 'no');
      put('fact-roots', upper(found.roots).join(', ') || found.remarks.join('; ') || '–', found.roots);
    },
    judged({ found, why }) {
      if (!found) return put('fact-regime', why);
      const { regime, transient, snaking } = found;
      const o = found.oscillation ?? snaking;
      const going = transient?.towards ? `, towards ${transient.towards}` : '';
      put('fact-regime', regime + going, regime);
      known('fact-period', o?.period, o?.period_error, UNITS.period);
      known('fact-amplitude', o?.amplitude_x0, o?.amplitude_x0_error, UNITS.amplitude);
      known('fact-swing', snaking?.amplitude_y0, snaking?.amplitude_y0_error, UNITS.amplitude);
      put('fact-remarks', found.remarks.join('; ') || 'none');
    },
    cycle({ found, why }) {
      const none = (id) => put(id, '–');
      if (!found) {
        put('fact-cycle', `none: ${why}`);
        return ['fact-cycle-amplitude', 'fact-wavelength', 'fact-multipliers', 'fact-cycle-stable'].forEach(none);
      }
      known('fact-cycle', found.period, found.period_error, UNITS.period);
      known('fact-cycle-amplitude', found.amplitude_x0, found.amplitude_x0_error, UNITS.amplitude);
      known('fact-wavelength', found.wavelength, found.wavelength_error, UNITS.wavelength);
      put('fact-cycle-stable', `${found.stable ? 'stable' : 'unstable'}, slips in a period: ${found.slips}`);
      put('fact-multipliers', upper(found.floquet.slice(0, 8)).join(', '), found.floquet);
    },
    /** One sentence for the line below the picture, which screen readers read out. */
    sentence({ alpha, r }) {
      const of = (id) => cell(id).textContent;
      const period = cell('fact-period').dataset.value ? `, period ${digits(JSON.parse(cell('fact-period').dataset.value), 6)} Γ/k` : '';
      const onset = cell('fact-critical').dataset.value ? ` Onset at α = ${digits(JSON.parse(cell('fact-critical').dataset.value), 6)}.` : '';
      return `α = ${digits(alpha, 6)}, r = ${digits(r, 6)}: ${of('fact-regime')}${period}.${onset}`;
    },
  };
}
