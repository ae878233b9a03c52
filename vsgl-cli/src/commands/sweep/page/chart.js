// Error against time; `chart.rs` draws the same without a script.

const chart = document.getElementById('chart');
const hint = element('div', { id: 'hint', hidden: true });

/** A logarithmic axis around these values; a number takes so much room along it. */
function axis(values, from, to, room) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const middle = Math.sqrt(low * high);
  const reach = Math.max(1.5, Math.sqrt(high / low) ** 1.08) * 1.08;
  const [least, most] = [middle / reach, middle * reach];
  const place = (value) => from + ((Math.log(Math.max(value, least)) - Math.log(least)) / Math.log(most / least)) * (to - from);
  // How much room there is for numbers.
  const roomy = Math.abs(to - from) / Math.log10(most / least) / room;
  const named = roomy > 9 ? [1, 2, 3, 5, 7] : roomy > 3.5 ? [1, 2, 5] : roomy > 2.2 ? [1, 3] : [1];
  const ticks = [];
  for (let decade = Math.floor(Math.log10(least)); decade <= Math.ceil(Math.log10(most)); decade++) {
    for (let digit = 1; digit < 10; digit++) {
      const value = digit * 10 ** decade;
      if (value >= least && value <= most) ticks.push([value, named.includes(digit)]);
    }
  }
  return { place, ticks };
}

function markPath(backend, x, y, full) {
  const r = full ? 5.5 : 4.5;
  switch (backend % 4) {
    case 0: return `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
    case 1: return `M${x - 0.9 * r} ${y - 0.9 * r}h${1.8 * r}v${1.8 * r}h${-1.8 * r}z`;
    case 2: return `M${x} ${y - 1.15 * r}l${1.1 * r} ${2 * r}h${-2.2 * r}z`;
    default: return `M${x} ${y - 1.25 * r}l${1.25 * r} ${1.25 * r}l${-1.25 * r} ${1.25 * r}l${-1.25 * r} ${-1.25 * r}z`;
  }
}

/** The points on the chart, fastest first: the order of the arrow keys. */
let order = [];

function drawChart() {
  const width = Math.max(260, Math.floor(chart.clientWidth));
  const height = Math.round(Math.min(500, Math.max(300, width * 0.64)));
  const [left, right, top, bottom] = [66, width - 14, 12, height - 48];
  const able = points.filter((point) => errorOf(point) !== null && timeOf(point)?.least > 0);
  const shown = able.filter(passes);
  order = [...shown].sort((a, b) => timeOf(a).median - timeOf(b).median || errorOf(a) - errorOf(b));
  const best = front();
  drawNote(able, shown, best);
  hint.hidden = true;
  if (!able.length) {
    chart.replaceChildren(element('p', { class: 'empty' }, 'No point has this error and this time.'));
    return;
  }
  // Axes hold what is filtered out as well, so that they stay where they are.
  const errors = able.map(errorOf).filter((error) => error > 0);
  const floor = noise();
  const inside = floor !== null && floor > 0.1 * Math.min(...errors);
  const across = axis(able.flatMap((point) => [timeOf(point).least, timeOf(point).most]), left, right, 42);
  const up = axis([...(errors.length ? errors : [1]), ...(inside ? [floor] : [])], bottom, top, 18);
  const name = `Error against time, ${shown.length} points. Arrow keys go from point to point.`;
  const svg = drawn('svg', { viewBox: `0 0 ${width} ${height}`, role: 'listbox', tabindex: 0, class: 'listbox', 'aria-label': name, onkeydown: arrows });
  if (inside) {
    const y = Math.min(up.place(floor), bottom);
    svg.append(drawn('rect', { class: 'noise', x: left, y, width: right - left, height: bottom - y }));
    svg.append(drawn('path', { class: 'noise-edge', d: `M${left} ${y}H${right}` }));
  }
  for (const [value, named] of across.ticks) {
    const x = across.place(value);
    svg.append(drawn('path', { class: named ? 'grid' : 'grid faint', d: `M${x} ${top}V${bottom}` }));
    if (named) svg.append(drawn('text', { class: 'tick', x, y: bottom + 18, 'text-anchor': 'middle' }, seconds(value, short)));
  }
  for (const [value, named] of up.ticks) {
    const y = up.place(value);
    svg.append(drawn('path', { class: named ? 'grid' : 'grid faint', d: `M${left} ${y}H${right}` }));
    if (named) svg.append(drawn('text', { class: 'tick', x: left - 7, y: y + 4, 'text-anchor': 'end' }, short(value) + unit(state.metric)));
  }
  const middle = (top + bottom) / 2;
  svg.append(drawn('text', { class: 'axis', x: (left + right) / 2, y: height - 8, 'text-anchor': 'middle' }, `${TIMES.get(state.time)} of a frame`));
  svg.append(drawn('text', { class: 'axis', x: 14, y: middle, 'text-anchor': 'middle', transform: `rotate(-90 14 ${middle})` }, `${metricName(state.metric)} (${state.metric === 'bias' ? '|bias|' : state.metric})`));

  const at = (point) => [across.place(timeOf(point).median), up.place(errorOf(point))];
  backends.forEach((backend, index) => {
    const steps = order.filter((point) => best.has(point) && point.backend === backend).map(at);
    if (!steps.length) return;
    const stairs = steps.slice(1).map(([x, y]) => `H${x}V${y}`).join('');
    svg.append(drawn('path', { class: `front b${index % 6}`, d: `M${steps[0][0]} ${steps[0][1]}${stairs}` }));
  });
  // What is on a front is drawn last, over the others.
  for (const point of [...order].sort((a, b) => best.has(a) - best.has(b))) {
    const index = backends.indexOf(point.backend);
    const [x, y] = at(point);
    const spread = timeOf(point);
    const full = best.has(point);
    svg.append(drawn('g', {
      class: `point b${index % 6}`, role: 'option', id: `point-${points.indexOf(point)}`,
      'aria-selected': String(point === state.chosen),
      'aria-label': `${label(point)}: ${seconds(spread.median)}, ${errorText(measured(point))}${full ? ', on the front' : ''}`,
      onclick: () => choose(point),
      onpointerenter: () => showHint(point, x, y, width),
      onpointerleave: () => { hint.hidden = true; },
    },
    drawn('circle', { class: 'hit', cx: x, cy: y, r: 11 }),
    drawn('path', { class: 'spread', d: `M${across.place(spread.least)} ${y}H${across.place(spread.most)}` }),
    drawn('path', { class: `mark${full ? ' full' : ''} b${index % 6}`, d: markPath(index, x, y, full) })));
  }
  if (state.chosen && order.includes(state.chosen)) {
    const [x, y] = at(state.chosen);
    svg.append(drawn('path', { class: 'guide', d: `M${left} ${y}H${x - 10}M${x} ${y + 10}V${bottom}` }));
    svg.append(drawn('circle', { class: 'ring', cx: x, cy: y, r: 10 }));
    svg.setAttribute('aria-activedescendant', `point-${points.indexOf(state.chosen)}`);
  }
  const focused = chart.contains(document.activeElement);
  chart.classList.add('live');
  chart.replaceChildren(svg, hint);
  if (focused) svg.focus({ preventScroll: true });
}

function showHint(point, x, y, width) {
  hint.replaceChildren(element('b', {}, `${seconds(timeOf(point).median)}, ${errorText(measured(point))}`), element('br'), label(point));
  hint.hidden = false;
  hint.style.top = `${y + 14}px`;
  hint.style.left = x < width / 2 ? `${x + 8}px` : '';
  hint.style.right = x < width / 2 ? '' : `${width - x + 8}px`;
}

function arrows(event) {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  const last = order.length - 1;
  const now = order.indexOf(state.chosen);
  const next = step ? Math.min(last, Math.max(0, now + step)) : event.key === 'Home' ? 0 : event.key === 'End' ? last : -1;
  if (next < 0) return;
  event.preventDefault();
  choose(order[next]);
}

/** Below the chart: what is shown, and what cannot be. */
function drawNote(able, shown, best) {
  const floor = noise();
  const without = points.length - able.length;
  const parts = [
    `${shown.length} of ${points.length} points, ${best.size} on the front: nothing else that is shown is both faster and nearer to the truth on the same backend.`,
    'Further down and further left is better. Bars reach from the fastest to the slowest run.',
    floor === null ? '' : `The noise of the reference itself is ${errorText(floor)} (grey, where the chart reaches so far); errors near it say little.`,
    without ? `${without} have no such ${points.some((point) => !timeOf(point)) ? 'time' : 'error'}.` : '',
  ];
  document.getElementById('chart-note').textContent = parts.filter(Boolean).join(' ');
}
