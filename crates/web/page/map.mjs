// Makes the precomputed map from a sweep of the default tip: stickslip sweep --r 0.05:2:79 --alpha 0.05:4:80 -o sweep.json,
// then node map.mjs sweep.json > map.json. Classes as in ../src/map.rs.
import { readFileSync } from 'node:fs';

const { parameters, points } = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const [MOST_SLIPS, TRAPPED, TRANSIENT, FAILED] = [3, 4, 5, 6];

function kind({ regime, slips, error }) {
  if (error) return FAILED;
  if (regime === 'steady') return 0;
  if (regime === 'stick-slip') return Math.min(Math.max(slips, 1), MOST_SLIPS);
  return regime === 'trapped' ? TRAPPED : TRANSIENT;
}
const { r, alpha } = parameters;
const known = new Map(points.map((point) => [`${point.r} ${point.alpha}`, kind(point)]));
const span = (list) => [list[0], list[list.length - 1], list.length];
const rows = r.map((v) => alpha.map((a) => known.get(`${v} ${a}`)).join(''));
console.log(JSON.stringify({ r: span(r), alpha: span(alpha), rows }));
