/** What was read of a drawing beside what was not: taken row by row, held against the plan of the part. */

import { h, refill } from '../dom.js';
import { sizeText } from '../gauge/plan.js';
import { explain, t } from '../i18n.js';
import { limitsSaid } from './characteristic.js';
import { findPlan, readDrawing, writePlan } from './plan_store.js';
import { planOf, rowsOf } from './revision.js';

const ASK_MS = 300;

export class DrawingReview {
  /** @param file that was read; @param on {onStored, onDraft, onCancel} */
  constructor(drawing, file, on) {
    Object.assign(this, { drawing, file, on });
    this.refused = new Set();
    this.byHand = new Map();
    this.part = h('input', { type: 'text', name: 'drawing-part', required: true, maxlength: 200, autocomplete: 'off', spellcheck: 'false', oninput: () => this.#partTyped() });
    this.part.value = drawing.part || file.name.replace(/\.[^.]+$/, '');
    this.against = h('p.against', { role: 'status' });
    this.note = h('p.note', { role: 'alert' });
    this.storing = h('button.primary', { type: 'submit' });
    this.editing = h('button', { type: 'button', onclick: () => this.#edit() }, t('drawing.edit'));
    this.readTitle = h('h3');
    this.rows = h('tbody');
    this.all = h('input', { type: 'checkbox', onchange: () => this.#takeAll(this.all.checked) });
    this.table = h('div.scroll.read', { tabindex: 0, role: 'region' }, h('table',
      h('thead', h('tr', h('th', h('label.choice', this.all, h('span.unseen', t('drawing.accept_all')))),
        ['plans.member.name', 'drawing.size', 'drawing.limits', 'plans.member.kind', 'drawing.state'].map((name) => h('th', { scope: 'col' }, t(name))))), this.rows));
    this.kept = h('p.aside');
    this.element = h('form.sheet.review', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#store(); } },
      h('h2.title', { tabindex: -1 }, t('drawing.title', { name: file.name })),
      h('div.line.of-part', h('label.field', h('span.label', t('plans.part')), this.part),
        h('p.actions', this.storing, this.editing, h('button', { type: 'button', onclick: () => on.onCancel() }, t('drawing.cancel')))),
      this.against, this.note, h('div.sides', h('section', this.readTitle, this.table, this.kept), this.#notRead()));
    this.ready = this.#compare();
  }

  /** The button that stores it, so that Enter does. */
  focus() {
    (this.storing.disabled ? this.part : this.storing).focus();
  }

  #partTyped() {
    clearTimeout(this.timer);
    this.storing.disabled = true;
    this.timer = setTimeout(() => this.#compare(), ASK_MS);
    this.typed = true;
  }

  /** What was typed last has been held against its plan. */
  #settled() {
    clearTimeout(this.timer);
    return this.typed ? this.#compare() : undefined;
  }

  get #number() {
    return this.part.value.trim();
  }

  /** Holds it against the plan of the part number, if there is one. */
  async #compare() {
    const part = this.#number;
    this.note.textContent = '';
    try {
      const { plan, tag } = part ? await findPlan(part) : { plan: null, tag: null };
      const drawing = plan ? await readDrawing(this.file, part) : this.drawing;
      if (part !== this.#number) return;
      this.typed = false;
      Object.assign(this, { plan, tag, found: rowsOf(drawing, plan) });
      this.refused.clear();
    } catch (problem) {
      Object.assign(this, { plan: null, tag: null, found: rowsOf(this.drawing, null) });
      this.note.textContent = explain(problem);
    }
    this.#draw();
  }

  #count(state) {
    return this.found.rows.filter((row) => row.state === state).length;
  }

  #draw() {
    const { plan, found: { rows, kept }, drawing } = this;
    const counts = Object.fromEntries(['added', 'changed', 'gone', 'same'].map((state) => [state, this.#count(state)]));
    const isSame = plan?.drawing?.digest === drawing.digest;
    this.against.textContent = !plan ? '' : [isSame && t('drawing.same_file', { part: this.#number }), t('drawing.revision', { part: this.#number, ...counts })].filter(Boolean).join(' ');
    this.element.classList.toggle('of-plan', Boolean(plan));
    this.readTitle.textContent = t('drawing.read', { count: drawing.sizes.length });
    this.table.setAttribute('aria-label', this.readTitle.textContent);
    this.kept.textContent = kept.length ? t('drawing.kept', { names: kept.map(({ name }) => name).join(', ') }) : '';
    refill(this.rows, rows.map((row) => this.#row(row)));
    if (!rows.length) this.rows.replaceChildren(h('tr', h('td', { colspan: 6 }, t('drawing.nothing'))));
    this.#state();
  }

  #row(row) {
    const { name, one, before, kind, state, remarks } = row;
    const box = h('input', { type: 'checkbox', disabled: state === 'same', onchange: () => this.#take(row, box.checked) });
    box.checked = !this.refused.has(name);
    const limits = h('td.number');
    limitsSaid(one).then((text) => { limits.textContent = text; });
    return h('tr', { 'data-state': state },
      h('td', h('label.choice', box, h('span.unseen', t('drawing.accept', { name })))),
      h('th', { scope: 'row' }, name, h('span.aside', [one.count > 1 && t('drawing.count', { count: one.count }), one.entity].filter(Boolean).join(' · '))),
      h('td.size', sizeText(one), state === 'changed' && h('span.aside.before', t('drawing.before', { text: sizeText(before) })),
        remarks.map((text) => h('span.aside.remark', { lang: 'en' }, text)), state === 'gone' && h('span.aside', t('drawing.gone_how'))),
      limits, h('td', t(`plans.kind.${kind}`)), h('td.state', h('span', t(`drawing.state.${state}`))));
  }

  #take(row, isTaken) {
    if (isTaken) this.refused.delete(row.name);
    else this.refused.add(row.name);
    this.#state();
  }

  #takeAll(isTaken) {
    for (const row of this.found.rows) if (row.state !== 'same') this.refused[isTaken ? 'delete' : 'add'](row.name);
    this.#draw();
    this.all.focus();
  }

  /** What is taken: whether there is something to store, and how it goes on. */
  #state() {
    const { rows } = this.found;
    const free = rows.filter(({ state }) => state !== 'same');
    const taken = free.filter(({ name }) => !this.refused.has(name)).length;
    this.all.checked = taken === free.length;
    this.all.indeterminate = taken > 0 && taken < free.length;
    this.all.disabled = !free.length;
    this.storing.textContent = t('plans.store');
    this.storing.disabled = !this.#number || !this.#plan.characteristics.length || this.byHand.size > 0;
    this.editing.disabled = !this.#number;
  }

  get #plan() {
    const plan = planOf(this.drawing, this.plan, this.found, ({ name }) => !this.refused.has(name));
    return { ...plan, characteristics: [...plan.characteristics, ...this.byHand.values()] };
  }

  /** Names with the same reason stand together. */
  #notRead() {
    const { not_read: left } = this.drawing;
    const reasons = new Map();
    for (const one of left) reasons.set(one.why, [...(reasons.get(one.why) ?? []), one]);
    return h('section.not-read', h('h3', t('drawing.not_read', { count: left.length })),
      left.length ? h('p.aside', t('drawing.not_read_how')) : h('p.aside', t('drawing.all_read')),
      h('ul', [...reasons].map(([why, all]) => h('li', h('p', { lang: 'en' }, why), h('p.names', all.map((one) => this.#chip(one)))))));
  }

  #chip({ name, entity }) {
    const button = h('button.chip', { type: 'button', 'aria-pressed': 'false', title: entity, 'aria-label': t('drawing.by_hand', { name, entity }), onclick: () => {
      if (!this.byHand.delete(entity)) this.byHand.set(entity, { name: this.#freeName(name, entity), entity });
      button.setAttribute('aria-pressed', String(this.byHand.has(entity)));
      this.#state();
    } }, name);
    return button;
  }

  /** A name that no other characteristic has. */
  #freeName(name, entity) {
    const names = new Set(this.#plan.characteristics.map((one) => one.name));
    return names.has(name) ? `${name} ${entity}` : name;
  }

  async #edit() {
    await this.#settled();
    this.on.onDraft({ ...this.#plan, part: this.#number }, this.tag);
  }

  async #store() {
    if (this.storing.disabled) return;
    await this.#settled();
    const part = this.#number;
    const plan = this.#plan;
    try {
      await writePlan(part, plan, this.tag);
      this.on.onStored(part, plan.characteristics.length);
    } catch (problem) {
      if (problem.status !== 412) {
        this.note.textContent = [explain(problem), ...(problem.errors ?? []).slice(0, 3).map(({ pointer, detail }) => `${pointer}: ${detail}`)].join(' ');
        return;
      }
      // Somebody was there first: it is held against what stands there now.
      await this.#compare();
      this.note.textContent = t('document.changed', { name: part });
    }
  }
}
