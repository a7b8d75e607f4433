// l, velocity, lateral force, and the distance from the line against time.
import uPlot from 'uplot';
import { colour } from './theme.js';

const CHARTS = [
  { id: 'chart-l', column: 1, label: 'l (σ)', words: 'l, the reduced lag' },
  { id: 'chart-v', column: 2, label: "x₀′ (kσ/Γ)", words: 'velocity of the tip' },
  { id: 'chart-f', column: 3, label: 'force (kσ)', words: 'lateral force, the extension of the spring' },
  { id: 'chart-y', column: 5, label: 'y0 (σ)', words: 'y0, the distance of the tip from its line', ofFree: true },
];
const HEIGHT = 150;

/** Range of an axis: with a margin, and wide enough that round-off does not look like motion and marks do not coincide. */
function range(u, low, high) {
  const least = 1e-6 * Math.max(1, Math.abs(low), Math.abs(high));
  if (high - low >= least) return uPlot.rangeNum(low, high, 0.1, true);
  const middle = (low + high) / 2;
  return [middle - least, middle + least];
}

export function charts(picked) {
  const sync = uPlot.sync('time');
  let plots = [];
  let columns = null;

  function options({ label }, width) {
    const axis = { stroke: colour('--ink'), grid: { stroke: colour('--grid'), width: 1 }, ticks: { show: false } };
    return {
      width,
      height: HEIGHT,
      legend: { show: false },
      cursor: { sync: { key: sync.key }, drag: { x: true, y: false } },
      scales: { x: { time: false }, y: { range } },
      axes: [
        { ...axis, size: 28, font: '12px system-ui' },
        { ...axis, size: 52, label, labelSize: 18, labelFont: '12px system-ui', font: '12px system-ui' },
      ],
      series: [{}, { stroke: colour('--line'), width: 1.5, points: { show: false } }],
      hooks: { ready: [(u) => u.over.addEventListener('click', () => pick(u))] },
    };
  }
  const pick = (u) => u.cursor.left >= 0 && picked(u.posToVal(u.cursor.left, 'x'));
  const data = (column) => [columns[0], columns[column]];
  const host = (chart) => document.getElementById(chart.id);

  function make() {
    plots.forEach((plot) => plot.destroy());
    plots = CHARTS.map((chart) => {
      const plot = new uPlot(options(chart, host(CHARTS[0]).clientWidth), data(chart.column), host(chart));
      const mark = document.createElement('div');
      mark.className = 'now';
      plot.over.append(mark);
      plot.mark = mark;
      return plot;
    });
  }
  const fit = () => CHARTS.forEach((chart, n) => plots[n]?.setSize({ width: host(CHARTS[0]).clientWidth, height: HEIGHT }));
  new ResizeObserver(fit).observe(host(CHARTS[0]));

  return {
    /** Columns of equal length, t first. `isFree`: the tip can leave its line. */
    draw(found, isFree) {
      columns = found;
      for (const chart of CHARTS) host(chart).hidden = Boolean(chart.ofFree) && !isFree;
      if (plots.length === 0) make();
      // A hidden chart takes as long to draw as one that is seen.
      else CHARTS.forEach((chart, n) => host(chart).hidden || plots[n].setData(data(chart.column)));
    },
    now(t) {
      for (const plot of plots) plot.mark.style.transform = `translateX(${plot.valToPos(t, 'x')}px)`;
    },
    redress: () => columns && make(),
    /** Describes the charts in words, for screen readers. */
    describe() {
      for (const chart of CHARTS) {
        const column = columns[chart.column];
        const [low, high] = column.reduce(([a, b], y) => [Math.min(a, y), Math.max(b, y)], [Infinity, -Infinity]);
        const words = `${chart.words}: from ${low.toPrecision(3)} to ${high.toPrecision(3)}`;
        host(chart).setAttribute('aria-label', words);
      }
    },
  };
}
