// What can be chosen; at the end, the page comes to life.

const controls = document.getElementById('controls');

/** A row of which one is pressed. */
function segments(key, title, options, able = () => true) {
  const inputs = options.map(([value, text]) => {
    const input = element('input', { type: 'radio', name: key, value, disabled: !able(value) });
    input.checked = state[key] === value;
    input.addEventListener('change', () => { state[key] = value; drawAll(); });
    return element('label', {}, input, text);
  });
  return element('fieldset', {}, element('legend', {}, title), element('div', { class: 'segments' }, ...inputs));
}

function named(title, control) {
  return element('label', {}, element('span', { class: 'name' }, title), control);
}

function drawControls() {
  const metric = element('select', { onchange: (event) => { state.metric = event.target.value; drawAll(); } },
    ...metrics.map((key) => element('option', { value: key }, `${key}: ${metricName(key)}`)));
  metric.value = state.metric;
  const filters = varied.map(([key, values]) => {
    const select = element('select', { onchange: (event) => filter(key, event.target.value) },
      element('option', { value: '*' }, 'all'), ...values.map((value) => element('option', { value: `=${value}` }, value)));
    return named(key, select);
  });
  controls.replaceChildren(
    segments('layer', 'Light', layers.map((layer) => [layer, layerName(layer)]), (layer) => points.some((point) => hasErrors(point, layer))),
    segments('scale', 'Over', scales.map((scale) => [scale, scaleName(scale)])),
    named('Error', metric),
    segments('time', 'Time', [...TIMES], (time) => points.some((point) => timeOf(point, time))),
    filters.length ? element('div', { class: 'filters' }, ...filters) : null,
  );
  controls.hidden = false;
}

function filter(key, value) {
  if (value === '*') state.filters.delete(key);
  else state.filters.set(key, value.slice(1));
  drawAll();
}

/** Backends can be put away. */
function drawLegend() {
  const items = backends.map((backend, index) => {
    const box = element('input', { type: 'checkbox' });
    box.checked = true;
    box.addEventListener('change', () => {
      if (box.checked) state.hidden.delete(backend); else state.hidden.add(backend);
      drawAll();
    });
    const mark = drawn('svg', { viewBox: '-8 -8 16 16', width: 16, height: 16, 'aria-hidden': 'true' }, drawn('path', { class: `mark full b${index % 6}`, d: markPath(index, 0, 0, true) }));
    const device = points.find((point) => point.backend === backend)?.device;
    return element('li', {}, element('label', {}, backends.length > 1 ? box : null, ' ', mark, ` ${backend}${device ? ` (${device})` : ''}`));
  });
  document.getElementById('legend').replaceChildren(...items);
}

function drawAll() {
  drawChart();
  drawChosen();
  drawTables();
}

function begin() {
  if (!points.length) return;
  const advised = (sweep.advice ?? []).map((entry) => byId(entry.id)).find(Boolean);
  const best = [...front()];
  state.chosen = advised ?? best[Math.floor(best.length / 2)] ?? points[0];
  drawControls();
  drawLegend();
  // The panel takes its place first: the chart is as wide as what is left.
  drawChosen();
  drawChart();
  drawTables();
  for (const box of document.querySelectorAll('main > section .command')) {
    if (!panel.contains(box)) box.append(copyButton(box.querySelector('code')));
  }
  for (const card of document.querySelectorAll('#advice li[data-id]')) {
    const point = byId(card.dataset.id);
    if (point) card.querySelector('.figures').append(' ', element('button', { type: 'button', onclick: () => show(point) }, 'Show'));
  }
  for (const image of document.querySelectorAll('figure[data-id] img')) {
    const point = byId(image.dataset.picture);
    if (!point) continue;
    image.classList.add('link');
    image.addEventListener('click', () => show(point));
  }
  let width = chart.clientWidth;
  new ResizeObserver(() => {
    if (chart.clientWidth === width) return;
    width = chart.clientWidth;
    drawChart();
  }).observe(chart);
}

begin();
