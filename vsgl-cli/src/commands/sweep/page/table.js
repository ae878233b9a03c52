// The tables of points: what is shown, sorted by what was asked for.

const columns = [
  { name: 'backend', text: (point) => point.backend, key: (point) => point.backend },
  ...varied.map(([key]) => ({ name: key, text: (point) => String(point.settings?.[key] ?? '–'), key: (point) => String(point.settings?.[key] ?? '') })),
  { name: 'virtual lights', number: true, text: (point) => (Number.isFinite(point.virtual_lights) ? grouped(String(point.virtual_lights)) : '–'), key: (point) => point.virtual_lights },
  ...[...TIMES].map(([time, name]) => ({ name, number: true, text: (point) => (timeOf(point, time) ? seconds(timeOf(point, time).median) : '–'), key: (point) => timeOf(point, time)?.median })),
  { name: 'error', number: true, text: (point) => errorText(measured(point)), key: (point) => errorOf(point) },
];

const tables = ['front-table', 'all-table'].map((id) => ({ table: document.getElementById(id), sort: columns.findIndex((column) => column.name === 'wall time'), down: false }));

function drawTables() {
  const best = front();
  const shown = points.filter(passes);
  const rows = [shown.filter((point) => best.has(point)), shown];
  tables.forEach((one, index) => { if (one.table) drawTable(one, rows[index], best); });
  const note = document.getElementById('front-note');
  note.textContent = `By ${layerName(state.layer)}, ${scaleName(state.scale)}, ${metricName(state.metric)} (${state.metric}), against ${TIMES.get(state.time)}. Choose a row to see it above.`;
  const title = document.querySelector('#all summary h2');
  title.textContent = shown.length === points.length ? `All ${points.length} points` : `${shown.length} of ${points.length} points`;
}

function drawTable(one, rows, best) {
  const column = columns[one.sort];
  const missing = (value) => value === null || value === undefined;
  const compare = (a, b) => {
    const [x, y] = [column.key(a), column.key(b)];
    if (missing(x) || missing(y)) return missing(x) - missing(y);
    return (one.down ? -1 : 1) * (typeof x === 'number' ? x - y : byNumberThenText(x, y));
  };
  const focused = one.table.contains(document.activeElement) ? document.activeElement.dataset.keep : null;
  const head = element('tr', {}, ...columns.map((of, index) => element('th', {
    scope: 'col', class: of.number ? 'number' : '', 'aria-sort': index === one.sort ? (one.down ? 'descending' : 'ascending') : 'none',
  }, element('button', { type: 'button', 'data-keep': `column-${index}`, onclick: () => { one.down = one.sort === index && !one.down; one.sort = index; drawTables(); } }, of.name))));
  const body = [...rows].sort(compare).map((point) => element('tr', {
    class: ['link', best.has(point) ? 'best' : '', point === state.chosen ? 'chosen' : ''].filter(Boolean).join(' '),
    onclick: () => show(point),
  }, ...columns.map((of, index) => element('td', { class: of.number ? 'number' : '' },
    index ? of.text(point) : element('button', { type: 'button', class: 'row', 'data-keep': `row-${points.indexOf(point)}`, 'aria-label': `Show ${label(point)}` }, of.text(point))))));
  one.table.tHead.replaceChildren(head);
  one.table.tBodies[0].replaceChildren(...body);
  if (focused) one.table.querySelector(`[data-keep="${focused}"]`)?.focus({ preventScroll: true });
}

/** Chooses a point from further down the page, and goes to it. */
function show(point) {
  choose(point);
  const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
  document.getElementById('explore').scrollIntoView({ behavior: calm ? 'auto' : 'smooth' });
}
