// Elements and numbers as text. Text is only ever set as text: names come from files.

const SVG = 'http://www.w3.org/2000/svg';

/** An element with attributes and children; a child that is a string is text. */
function element(name, attributes = {}, ...children) {
  return fill(document.createElement(name), attributes, children);
}

function drawn(name, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, name), attributes, children);
}

function fill(made, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, '');
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Three significant digits, thousands grouped from 10,000 on. */
function number(value) {
  const size = Math.abs(value);
  if (value === 0 || !Number.isFinite(value)) return String(value);
  const sign = value < 0 ? '\u2212' : '';
  if (size < 1e-4) return sign + size.toExponential(1).replace('-', '\u2212');
  const decimals = Math.max(0, 2 - Math.floor(Math.log10(size)));
  const text = size.toFixed(decimals);
  return sign + (decimals ? text : grouped(text));
}

function grouped(digits) {
  return digits.length < 5 ? digits : digits.replace(/\B(?=(\d{3})+$)/g, ',');
}

function short(value) {
  const text = number(value);
  return text.includes('.') && !text.includes('e') ? text.replace(/\.?0+$/, '') : text;
}

function seconds(value, write = number) {
  if (value < 0.9995e-3) return `${write(value * 1e6)} µs`;
  if (value < 0.9995) return `${write(value * 1e3)} ms`;
  if (value < 120 || write === short) return `${write(value)} s`;
  return `${write(value / 60)} min`;
}

/** What metrics are called, and their unit behind a number. */
const METRICS = new Map([
  ['mape', ['mean error', ' %']],
  ['rmspe', ['root mean square error', ' %']],
  ['smape', ['symmetric mean error', ' %']],
  ['relmse', ['relative mean square error', '']],
  ['bias', ['light too much or too little', ' %']],
  ['mape_median', ['median error', ' %']],
]);
const LAYERS = new Map([['indirect', 'indirect light'], ['whole', 'whole picture']]);
const TIMES = new Map([['wall', 'wall time'], ['cpu', 'CPU time']]);

const metricName = (metric) => (METRICS.get(metric) ?? [metric])[0];
const unit = (metric) => (METRICS.get(metric) ?? ['', ''])[1];
const layerName = (layer) => LAYERS.get(layer) ?? layer;
const scaleName = (scale) => (scale === '1' ? 'pixels' : `${scale} × ${scale} boxes`);
