/** What a run did: verdict, messages, screen, measurements, path, parameters, files. */

import { get, getJson, url } from '../api.js';
import { h } from '../dom.js';
import { mmText, NM_PER_MM, NM_PER_UM, umText } from '../exact.js';
import { pathView, prepareSpace } from '../figures/path_view.js';
import { Trace } from '../figures/trace.js';
import { explain, number, signed, t } from '../i18n.js';
import { limitsText, verdictMark } from '../verdict.js';
import { fileName } from './disk.js';
import { placeText } from './findings.js';
import { logFrame } from './log_frame.js';
import { MoveSlider } from './move_slider.js';

export const screenOf = (lines) => h('pre.screen', { tabindex: 0, 'aria-label': t('programs.screen') }, lines.join('\n') || ' ');

/** @param onMoves takes the slider through the moves and their figure once they are there; @param onMove the move it shows */
export async function runReport(run, { onMoves, onMove }) {
  const [path, times] = [h('div'), h('div')];
  drawPath(run, path, times, { onMoves, onMove });
  return [
    h('div.line', h('p.headline', t(`run.${run.status}`)), run.verdict && verdictMark(run.verdict),
      h('p.aside', t('programs.ran', { blocks: run.blocks_executed, seconds: number((run.machining_time_s ?? 0).toFixed(1)) }))),
    path,
    run.messages?.length > 0 && h('ul.messages', run.messages.map((message) => h('li',
      h('strong', message.number ? `${message.number} ` : '', message.text),
      h('span.aside', [fileName(message.program ?? ''), message.line && placeText(message)].filter(Boolean).join(' · '))))),
    run.measurements?.length > 0 && measured(run.measurements),
    times,
    run.screen?.length > 0 && screenOf(run.screen),
    files(run),
    parameters(run.parameters ?? {}),
  ].filter(Boolean);
}

/** The columns of what was measured: their names and units. Those that say how it is come first: they are in sight in a narrow place too. */
const COLUMNS = [['trend.verdict'], ['parts.deviation', 'µm'], ['field.characteristic'], ['programs.measured', 'mm'], ['programs.nominal', 'mm'], ['parts.limits', 'mm'], ['programs.cycle']];
const hasLimits = (size) => size.upper_limit_mm !== undefined || size.lower_limit_mm !== undefined;

/** Equally many decimals in a column. */
const millimetres = (value) => number(mmText(Math.round(value * NM_PER_MM)));

function measured(measurements) {
  const rows = measurements.flatMap(({ cycle, sizes }) => sizes.map((size) => h('tr', h('td', size.verdict ? verdictMark(size.verdict) : ''),
    h('td.number', signed(umText(Math.round(size.deviation_um * NM_PER_UM)))), h('td', size.characteristic), h('td.number', millimetres(size.measured_mm)),
    h('td.number', millimetres(size.nominal_mm)), h('td', hasLimits(size) ? limitsText(size).replace(/ mm$/, '') : '–'), h('td', String(cycle)))));
  return h('div.wide.sizes', { tabindex: 0, role: 'region', 'aria-label': t('programs.measurements') }, h('table', h('caption', t('programs.measurements')),
    h('thead', h('tr', COLUMNS.map(([name, unit]) => h('th', { scope: 'col', class: unit && name !== 'parts.limits' && 'number' }, unit ? `${t(name)}, ${unit}` : t(name))))), h('tbody', rows)));
}

async function drawPath(run, place, times, { onMoves, onMove }) {
  try {
    const space = prepareSpace();
    const [bytes, order] = await Promise.all([
      get(url(['runs', run.id, 'trace'])).then((answer) => answer.arrayBuffer()), getJson(url(['runs', run.id, 'request']))]);
    const trace = new Trace(new Uint8Array(bytes));
    if (!trace.length) return;
    const figure = await pathView(trace, order.setup?.workpiece?.features ?? [], space,
      { radius: radiusOf(order.setup?.machine?.tools), sphere: order.setup?.machine?.calibration_sphere });
    const slider = new MoveSlider(trace, run.program, times, (move, block) => {
      figure.show(move);
      onMove(block ?? move);
    });
    place.replaceChildren(figure.element, slider.element);
    onMoves(slider, figure);
  } catch (problem) {
    place.replaceChildren(h('p.aside', explain(problem)));
  }
}

/** The ball of the probe, where the setup has one that differs from the usual. */
const radiusOf = (tools = []) => tools.find((tool) => tool.probe > 0 || tool.number === 30)?.radius_mm;

function files(run) {
  const place = h('div');
  const show = async (name) => place.replaceChildren(await logFrame(run.id, name).catch((problem) => h('p.note', explain(problem))));
  return run.files?.length > 0 && h('section', h('h2', t('programs.written')),
    h('p.actions', run.files.map(({ path }) => h('button', { type: 'button', onclick: () => show(fileName(path)) }, fileName(path)))), place);
}

function parameters(values) {
  const names = Object.keys(values);
  return names.length > 0 && h('details', h('summary', t('programs.parameters_end', { count: names.length })),
    h('dl.parameters', names.map((name) => h('div', h('dt', name), h('dd', number(values[name]))))));
}
