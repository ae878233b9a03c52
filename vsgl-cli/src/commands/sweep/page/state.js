// The document, what is chosen, and the points that go with it.

const sweep = JSON.parse(document.getElementById('document').textContent);
const points = Array.isArray(sweep.points) ? sweep.points : [];
const backends = [...new Set(points.map((point) => point.backend))];

const layers = known((point) => Object.keys(point.errors ?? {}), [...LAYERS.keys()]);
const scales = known((point) => Object.values(point.errors ?? {}).flatMap((of) => Object.keys(of ?? {})), ['1', '8']);
const metrics = known(
  (point) => Object.values(point.errors ?? {}).flatMap((of) => Object.values(of ?? {}).flatMap((at) => Object.keys(at ?? {}))),
  [...METRICS.keys()],
).filter((metric) => METRICS.has(metric));

/** What occurs in points, in this order; what is not in it comes last. */
function known(of, order) {
  const all = [...new Set(points.flatMap(of))];
  const rank = (key) => (order.includes(key) ? order.indexOf(key) : order.length);
  return all.sort((a, b) => rank(a) - rank(b));
}

/** The settings that differ among points, with all their values. */
const varied = (() => {
  const values = new Map();
  for (const point of points) {
    for (const [key, value] of Object.entries(point.settings ?? {})) {
      if (!values.has(key)) values.set(key, new Set());
      values.get(key).add(String(value));
    }
  }
  const everywhere = (key) => points.every((point) => Object.hasOwn(point.settings ?? {}, key));
  const first = ['lights', 'interleave', 'occlusion'];
  const rank = (key) => (first.includes(key) ? first.indexOf(key) : first.length);
  return [...values]
    .filter(([key, of]) => of.size > 1 || !everywhere(key))
    .map(([key, of]) => [key, [...of].sort(byNumberThenText)])
    .sort(([a], [b]) => rank(a) - rank(b) || (a < b ? -1 : 1));
})();

function byNumberThenText(a, b) {
  const [x, y] = [Number(a), Number(b)];
  if (a !== '' && b !== '' && !Number.isNaN(x) && !Number.isNaN(y)) return x - y;
  return a < b ? -1 : a > b ? 1 : 0;
}

const state = {
  layer: layers.find((layer) => layer === 'indirect' && points.some((point) => hasErrors(point, layer))) ?? layers.at(-1) ?? 'whole',
  scale: scales.includes('8') ? '8' : scales[0] ?? '1',
  metric: metrics[0] ?? 'mape',
  time: 'wall',
  hidden: new Set(),
  filters: new Map(),
  chosen: null,
};

function hasErrors(point, layer) {
  return Object.values(point.errors?.[layer] ?? {}).some((scale) => scale !== null);
}

/** The error as it was measured: bias has a sign. */
function measured(point, choice = state) {
  return point.errors?.[choice.layer]?.[choice.scale]?.[choice.metric] ?? null;
}

/** The error on the axis; null where there is none. */
function errorOf(point) {
  const value = measured(point);
  return value === null || !Number.isFinite(value) ? null : Math.abs(value);
}

/** Median, least and most seconds. */
function timeOf(point, time = state.time) {
  const spread = point[time];
  return Number.isFinite(spread?.median) ? { least: spread.median, most: spread.median, ...spread } : null;
}

function noise() {
  const value = sweep.reference?.noise?.[state.layer]?.[state.scale]?.[state.metric];
  return Number.isFinite(value) && value !== 0 ? Math.abs(value) : null;
}

function passes(point) {
  if (state.hidden.has(point.backend)) return false;
  return [...state.filters].every(([key, value]) => String(point.settings?.[key] ?? '') === value);
}

/** The points that no other of their backend beats among those that are shown. */
function front() {
  const best = new Set();
  for (const backend of backends) {
    const of = points.filter((point) => point.backend === backend && passes(point) && errorOf(point) !== null && timeOf(point));
    of.sort((a, b) => timeOf(a).median - timeOf(b).median || errorOf(a) - errorOf(b));
    let least = Infinity;
    for (const point of of) {
      if (errorOf(point) >= least) continue;
      least = errorOf(point);
      best.add(point);
    }
  }
  return best;
}

const byId = (id) => points.find((point) => point.id === id);
const label = (point) => `${point.backend}: ${point.name || point.id}`;
const errorText = (value, metric = state.metric) => (Number.isFinite(value) ? number(value) + unit(metric) : '–');

/** The address of an embedded picture: a point's, or without one the reference's. */
function picture(point) {
  const image = point ? [...document.querySelectorAll('img[data-picture]')].find((i) => i.dataset.picture === point.id) : document.getElementById('reference');
  return image ? image.getAttribute('src') : null;
}
