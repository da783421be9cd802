/** The tokens and components of the page in one place, for those who change it: the tests photograph it. */

import { h } from '../dom.js';
import { t } from '../i18n.js';
import { verdictMark, VERDICTS } from '../verdict.js';

const COLOURS = ['paper', 'sheet', 'ink', 'soft', 'line', 'edge', 'focus', 'alarm', 'code-text', 'code-parameter', 'screen', 'on-screen', 'document', 'good', 'rework', 'reject', 'indeterminate'];
const TYPES = [1, 2, 3, 4, 5, 6, 7];
const SPACES = [1, 2, 3, 4];

const valueOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const section = (name, ...content) => h('section.sheet', h('h2', t(`style.${name}`)), content);

export function mount(main) {
  const swatches = COLOURS.map((name) => {
    const sample = h('span.sample');
    sample.style.background = `var(--${name})`;
    return h('li', sample, h('code', `--${name}`), h('span.aside', valueOf(`--${name}`)));
  });
  const types = TYPES.map((step) => {
    const sample = h('span', 'Ø 25 H7 · 25.013');
    sample.style.fontSize = `var(--type-${step})`;
    return h('li', sample, h('code', `--type-${step}`), h('span.aside', valueOf(`--type-${step}`)));
  });
  const spaces = SPACES.map((step) => {
    const sample = h('span.sample');
    sample.style.width = `var(--space-${step})`;
    return h('li', sample, h('code', `--space-${step}`), h('span.aside', valueOf(`--space-${step}`)));
  });
  const button = (name, attributes, text = t('style.button')) => h(name, { type: 'button', ...attributes }, text);
  main.replaceChildren(h('div.desk.tokens', h('h1', { tabindex: -1 }, t('view.style')),
    section('colours', h('ul.swatches', swatches)), section('type', h('ul.types', types), h('p.aside', t('style.least'))), section('space', h('ul.swatches', spaces)),
    section('buttons', h('p.actions', button('button.primary'), button('button'), button('button', { disabled: true }), button('button.quiet'), h('div.switch', button('button', { 'aria-pressed': 'true' }), button('button', { 'aria-pressed': 'false' })))),
    section('fields', h('div.study-fields', [{}, { value: '25.013' }, { disabled: true }, { 'aria-invalid': 'true', value: '25..013' }].map((attributes) =>
      h('label.field', h('span.label', t('style.label')), h('input', { type: 'text', ...attributes }), h('span.hint', t('style.hint')))))),
    section('verdicts', h('div.line', VERDICTS.map(verdictMark))),
    section('table', h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('style.table') }, h('table', h('thead', h('tr', ['field.characteristic', 'trend.value', 'trend.verdict'].map((name) => h('th', { scope: 'col' }, t(name))))),
      h('tbody', VERDICTS.map((verdict, i) => h('tr', h('th', { scope: 'row' }, `bore-${i + 1}`), h('td', '25.013 mm'), h('td', verdictMark(verdict)))))))),
    section('states', h('p.empty', t('trend.empty')), h('p.note', t('error.away')), h('p.note', { role: 'status' }, t('loading')))));
}
