// What is known of the chosen point.

const panel = document.getElementById('chosen');
const slider = { at: 50, difference: false, against: '' };

function choose(point) {
  state.chosen = point;
  drawChart();
  drawChosen();
  drawTables();
}

function drawChosen() {
  const point = state.chosen;
  panel.hidden = !point;
  if (!point) return;
  const focused = document.activeElement?.dataset?.keep;
  const runs = point.runs ? `${point.runs} run${point.runs === 1 ? '' : 's'}` : '';
  const time = timeOf(point);
  const facts = [point.device, Number.isFinite(point.virtual_lights) ? `${grouped(String(point.virtual_lights))} virtual lights` : ''];
  const range = time && time.most > time.least ? `${seconds(time.least)} to ${seconds(time.most)}` : '';
  panel.replaceChildren(
    element('h3', {}, label(point)),
    element('p', { class: 'small' }, facts.filter(Boolean).join(', ')),
    element('div', { class: 'pair' },
      element('div', {}, element('b', {}, time ? seconds(time.median) : '–'), element('span', {}, [TIMES.get(state.time), [runs, range].filter(Boolean).join(', ')].filter(Boolean).join(': '))),
      element('div', {}, element('b', {}, errorText(measured(point))), element('span', {}, `${state.metric}, ${layerName(state.layer)}, ${scaleName(state.scale)}`))),
    pictures(point),
    phases(point),
    settings(point),
    element('h4', {}, 'Command'),
    command(point.command ?? ''),
    errors(point),
  );
  if (focused) panel.querySelector(`[data-keep="${focused}"]`)?.focus({ preventScroll: true });
}

/** Two pictures, one over the other, with an edge to drag between them. */
function pictures(point) {
  const own = picture(point);
  const against = byId(slider.against);
  const other = picture(against) ?? picture(null);
  if (!own || !other) {
    const folder = typeof point.picture === 'string' ? ` Its picture is ${point.picture} in the folder of the sweep.` : '';
    return element('p', { class: 'empty' }, `This page holds pictures of the front alone.${folder}`);
  }
  const upper = element('img', { src: own, alt: `Picture with ${label(point)}` });
  const edge = element('div', { class: 'edge' });
  const range = element('input', { type: 'range', min: 0, max: 100, step: 0.5, 'aria-label': 'Edge between the two pictures', 'data-keep': 'edge' });
  const box = element('div', { class: 'compare' },
    element('img', { src: other, alt: against ? `Picture with ${label(against)}` : 'The reference' }), upper, range, edge,
    element('span', { class: 'side left' }, against ? 'other' : 'reference'), element('span', { class: 'side right' }, 'chosen'));
  const place = () => {
    box.classList.toggle('difference', slider.difference);
    upper.style.clipPath = slider.difference ? 'none' : `inset(0 0 0 ${slider.at}%)`;
    edge.style.left = `${slider.at}%`;
  };
  range.value = slider.at;
  range.addEventListener('input', () => { slider.at = Number(range.value); place(); });
  place();
  const difference = element('input', { type: 'checkbox', 'data-keep': 'difference' });
  difference.checked = slider.difference;
  difference.addEventListener('change', () => { slider.difference = difference.checked; place(); });
  const others = points.filter((one) => one !== point && picture(one));
  const select = element('select', { 'aria-label': 'Compare with', 'data-keep': 'against', onchange: (event) => { slider.against = event.target.value; drawChosen(); } },
    element('option', { value: '' }, 'the reference'), ...others.map((one) => element('option', { value: one.id }, label(one))));
  select.value = against && against !== point ? against.id : '';
  return element('div', {}, box, element('div', { class: 'tools' },
    element('label', {}, 'against ', select), element('label', {}, difference, ' difference × 4')));
}

const phaseNames = [...new Set(points.flatMap((point) => (point.phases ?? []).map((phase) => phase.phase)))];

/** Where the time goes, as a bar. */
function phases(point) {
  const clock = state.time === 'cpu' && (point.phases ?? []).some((phase) => Number.isFinite(phase.cpu)) ? 'cpu' : 'wall';
  const parts = (point.phases ?? []).map((phase) => ({ name: phase.phase, time: phase[clock] })).filter((part) => part.time > 0);
  const whole = timeOf(point, clock)?.median ?? 0;
  const sum = parts.reduce((all, part) => all + part.time, 0);
  if (!parts.length) return null;
  if (whole - sum > 0.005 * whole) parts.push({ name: 'between phases', time: whole - sum });
  const all = parts.reduce((total, part) => total + part.time, 0);
  const colour = (part) => (phaseNames.includes(part.name) ? `p${phaseNames.indexOf(part.name) % 8}` : 'p6');
  const bar = drawn('svg', { class: 'bar', viewBox: '0 0 1000 22', preserveAspectRatio: 'none', role: 'img', 'aria-label': 'Share of each phase; the list below has the numbers' });
  let x = 0;
  for (const part of parts) {
    const width = (1000 * part.time) / all;
    bar.append(drawn('rect', { class: colour(part), x, y: 0, width, height: 22 }, drawn('title', {}, `${part.name}: ${seconds(part.time)}`)));
    x += width;
  }
  const list = parts.map((part) => element('li', {},
    drawn('svg', { width: 11, height: 11, 'aria-hidden': 'true' }, drawn('rect', { class: colour(part), width: 11, height: 11, rx: 2 })),
    part.name, element('span', {}, seconds(part.time))));
  return element('div', {}, element('h4', {}, `Phases, ${TIMES.get(clock)}`), bar, element('ul', { class: 'phases' }, ...list));
}

/** Settings that differ among points first. */
function settings(point) {
  const keys = Object.keys(point.settings ?? {});
  const differs = (key) => varied.some(([other]) => other === key);
  const first = varied.map(([key]) => key).filter((key) => keys.includes(key));
  const chip = (key) => element('li', { class: differs(key) ? '' : 'same' }, `${key} ${point.settings[key]}`);
  if (!keys.length) return null;
  const rest = keys.filter((key) => !differs(key));
  const more = rest.length > 8
    ? element('details', {}, element('summary', {}, `${rest.length} settings that all points share`), element('ul', { class: 'settings' }, ...rest.map(chip)))
    : null;
  return element('div', {}, element('h4', {}, 'Settings'), element('ul', { class: 'settings' }, ...first.map(chip), ...(more ? [] : rest.map(chip))), more);
}

/** All its errors. */
function errors(point) {
  const columns = layers.flatMap((layer) => scales.map((scale) => ({ layer, scale }))).filter(({ layer, scale }) => point.errors?.[layer]?.[scale]);
  if (!columns.length) return null;
  const head = element('tr', {}, element('th', {}), ...columns.map(({ layer, scale }) => element('th', { scope: 'col', class: 'number' }, layer, element('br'), scaleName(scale))));
  const rows = metrics.map((metric) => element('tr', {}, element('th', { scope: 'row', title: metricName(metric) }, metric),
    ...columns.map((column) => element('td', { class: 'number' }, errorText(measured(point, { ...column, metric }), metric)))));
  return element('details', {}, element('summary', {}, 'All errors'), element('div', { class: 'scroll' }, element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows))));
}

/** A command with a button that copies it. */
function command(line) {
  const code = element('code', {}, ...line.split(' ').flatMap((word) => [element('span', {}, word), ' ']).slice(0, -1));
  return element('div', { class: 'command' }, code, copyButton(code));
}

function copyButton(code) {
  const button = element('button', { type: 'button' }, 'Copy');
  const said = (text) => {
    button.textContent = text;
    setTimeout(() => { button.textContent = 'Copy'; }, 1500);
  };
  // Where the clipboard is not to be had, the text is marked, ready for the keys that copy.
  const mark = () => {
    getSelection().selectAllChildren(code);
    said(document.execCommand('copy') ? 'Copied' : 'Marked');
  };
  button.addEventListener('click', () => {
    if (!navigator.clipboard) return mark();
    navigator.clipboard.writeText(code.textContent).then(() => said('Copied'), mark);
  });
  return button;
}
