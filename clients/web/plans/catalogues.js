/** Catalogues of causes and actions, which the station offers after a value that is not good: each as two lists in their order. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { confirm } from '../confirm.js';
import { mayDrop, readDocument, removeDocument, sayStoredFirst, writeDocument } from '../documents.js';
import { field, h, refill } from '../dom.js';
import { explain, t } from '../i18n.js';
import { inTurn } from '../latest.js';
import { go } from '../route.js';
import { forget, readJson, store as keep, storedKeys } from '../stored.js';
import { iconButton, sortable } from './sorting.js';

const DRAFTS = 'catalogue-draft/';
const LISTS = { causes: 'cause', measures: 'measure' };
const EMPTY = { causes: [], measures: [] };
const pathOf = (name) => ['catalogues', name];

export class Catalogues {
  #current = null; // {name, tag}; the name is '' and the tag null while it is new
  #before = '';

  /** @param onStored is told that names have changed; @param leaving ends the view */
  constructor({ onStored, leaving }) {
    Object.assign(this, { onStored, leaving });
    const button = (name, onclick, selector = 'button') => h(selector, { type: 'button', onclick: () => this.#attempt(onclick) }, t(name));
    this.note = h('p.note', { role: 'alert' });
    this.done = h('p.done', { role: 'status' });
    this.names = h('ul.line');
    this.name = h('input', { type: 'text', name: 'catalogue-name', autocomplete: 'off', spellcheck: 'false', maxlength: 200, oninput: () => this.#drawState() });
    this.lists = Object.fromEntries(Object.keys(LISTS).map((list) => [list, h('ol', { 'aria-label': t(`catalogue.${list}`) })]));
    this.adding = Object.fromEntries(Object.entries(LISTS).map(([list, one]) => [list, button(`catalogue.add_${one}`, () => this.#add(list, '').focus())]));
    this.state = h('span.aside', { role: 'status' });
    this.deleting = button('plans.delete', () => this.#remove());
    this.form = h('form.sheet', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#attempt(() => this.#store()); } },
      h('div.line', field(t('catalogue.name'), this.name), this.state, h('p.actions', h('button.primary', { type: 'submit' }, t('catalogue.store')), this.deleting, button('catalogue.close', () => this.#close()))),
      h('div.sides', Object.entries(this.lists).map(([list, element]) => {
        sortable(element, (row) => this.#moved(element, row));
        return h('section', h('h3', t(`catalogue.${list}`)), element, this.adding[list]);
      })));
    this.element = h('section.catalogues', { 'aria-labelledby': 'catalogues-title' }, h('h2', { id: 'catalogues-title' }, t('catalogue.title')), h('p.hint', t('catalogue.how')),
      h('p.actions', this.names, button('catalogue.begin', () => this.#edit())), this.done, this.note, this.form);
    this.listing = new Asked(() => this.#list(), { say: (text) => { this.note.textContent = text; }, leaving });
    addEventListener('pagehide', () => this.keepDraft(), { signal: leaving });
    this.#show();
  }

  /** @param name of the one that is opened */
  begin(name) {
    this.#attempt(async () => {
      await this.listing.run();
      const kept = name === undefined ? storedKeys(DRAFTS, 'session')[0] : DRAFTS + name;
      const draft = kept && readJson(kept, null, 'session');
      if (draft) {
        forget(kept, 'session');
        this.#fill(draft.value, draft, draft.typed);
      } else if (name) await this.#open(name);
    });
  }

  /** What was changed and not stored is kept while the window lives. */
  keepDraft() {
    if (!this.#current) return;
    const kept = DRAFTS + this.#current.name;
    if (this.#isDirty) keep(kept, JSON.stringify({ ...this.#current, value: this.value, typed: this.name.value }), 'session');
    else forget(kept, 'session');
  }

  get value() {
    return Object.fromEntries(Object.entries(this.lists).map(([list, element]) => [list, [...element.querySelectorAll('input')].map(({ value }) => value.trim()).filter(Boolean)]));
  }

  get #text() {
    return JSON.stringify([this.name.value.trim(), this.value]);
  }

  get #isDirty() {
    return this.#current !== null && this.#text !== this.#before;
  }

  async #attempt(action) {
    this.note.textContent = '';
    try {
      await action();
    } catch (problem) {
      if (!this.leaving.aborted) this.note.textContent = explain(problem);
    }
  }

  async #list() {
    const { catalogues } = await getJson(url(['catalogues']), { signal: this.leaving });
    refill(this.names, catalogues.map(({ name }) => h('li', h('button.quiet', { type: 'button', 'aria-current': name === this.#current?.name && 'true', onclick: () => this.#attempt(() => this.#open(name)) }, name))));
    this.names.hidden = !catalogues.length;
  }

  #drawState() {
    this.state.textContent = this.#isDirty ? t('plans.not_stored') : '';
  }

  #show() {
    this.form.hidden = !this.#current;
    if (!this.#current) return;
    this.deleting.hidden = this.#current.tag === null;
    this.#drawState();
  }

  /** @param typed the name that was typed in a draft, which is not stored and leaves the address as it is */
  #fill(value, { name, tag }, typed) {
    this.#current = { name, tag };
    this.name.value = typed ?? name;
    for (const [list, element] of Object.entries(this.lists)) {
      element.replaceChildren();
      for (const text of value[list].length ? value[list] : ['']) this.#add(list, text);
    }
    this.done.textContent = '';
    if (typed === undefined) return this.#settle({ name, tag }, this.#text);
    this.#before = '';
    this.#show();
  }

  /** @param text of the form as it is stored */
  #settle(current, text) {
    this.#current = current;
    this.#before = text;
    go({ view: 'plans', options: { catalogue: current.name } }, { refine: true });
    this.#show();
  }

  async #mayLeave() {
    return !this.#isDirty || mayDrop();
  }

  async #open(name, said = '') {
    if (!await this.#mayLeave()) return;
    const { body, tag } = await readDocument(pathOf(name), this.leaving);
    this.#fill(body, { name, tag });
    this.done.textContent = said;
    await this.listing.run();
  }

  async #edit() {
    if (!await this.#mayLeave()) return;
    this.#fill(EMPTY, { name: '', tag: null });
    this.name.focus();
  }

  async #close() {
    if (!await this.#mayLeave()) return;
    this.#current = null;
    go({ view: 'plans' }, { refine: true });
    this.#show();
    await this.listing.run();
  }

  /** An entry; Enter in it goes on to the next, and several lines that are pasted are an entry each. */
  #add(list, text, after = this.lists[list].lastElementChild) {
    const input = h('input', { type: 'text', autocomplete: 'off', maxlength: 200, value: text, oninput: () => { input.removeAttribute('aria-invalid'); say(); this.#drawState(); } });
    const [grip, remove] = [iconButton('grip', ''), iconButton('remove', '', { onclick: () => {
      const next = (row.nextElementSibling ?? row.previousElementSibling)?.querySelector('input') ?? this.adding[list];
      row.remove();
      next.focus();
      this.#drawState();
    } })];
    const row = h('li.line', grip, input, remove);
    const say = () => {
      const name = input.value.trim() || t(`note.${LISTS[list]}`);
      input.setAttribute('aria-label', t(`note.${LISTS[list]}`));
      for (const [button, of] of [[grip, 'plans.move_this'], [remove, 'plans.remove_one']]) button.title = button.ariaLabel = t(of, { name });
    };
    input.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter') return;
      event.preventDefault();
      this.#add(list, '', row).focus();
    });
    input.addEventListener('paste', (event) => {
      const lines = event.clipboardData.getData('text').split(/\r?\n/).map((line) => line.trim()).filter(Boolean);
      if (lines.length < 2) return;
      event.preventDefault();
      let last = row;
      for (const line of lines) last = this.#add(list, line, last).closest('li');
      if (!input.value) row.remove();
      last.querySelector('input').focus();
    });
    if (after) after.after(row);
    else this.lists[list].append(row);
    say();
    this.#drawState();
    return input;
  }

  #moved(element, row) {
    const rows = [...element.children];
    this.done.textContent = t('plans.moved', { name: row.querySelector('input').value, number: rows.indexOf(row) + 1, count: rows.length });
    this.#drawState();
  }

  /** @param replacing whether what stands there now is replaced, whoever has written it */
  #store = inTurn(async ({ replacing = false } = {}) => {
    const name = this.name.value.trim();
    if (!name) {
      this.note.textContent = t('catalogue.name_missing');
      this.name.focus();
      return;
    }
    const current = this.#current;
    if (!current) return;
    const { name: old, tag } = current;
    const isOther = tag !== null && name !== old;
    for (const row of this.form.querySelectorAll('li')) if (!row.querySelector('input').value.trim()) row.remove();
    for (const input of this.form.querySelectorAll('[aria-invalid]')) input.removeAttribute('aria-invalid');
    const [value, text] = [this.value, this.#text];
    try {
      const stored = await writeDocument(pathOf(name), value, replacing ? undefined : isOther ? null : tag);
      if (this.#current === current) this.#settle({ name, tag: stored }, text);
    } catch (problem) {
      if (problem.status === 412) {
        const open = () => this.#attempt(() => { this.#before = this.#text; return this.#open(name); });
        return sayStoredFirst(this.note, name, isOther || tag === null, { open, replace: () => this.#attempt(() => this.#store({ replacing: true })) });
      }
      return this.#mark(problem);
    }
    this.onStored();
    const kept = isOther && await removeDocument(pathOf(old), tag).then(() => '', explain);
    this.done.textContent = [t('catalogue.stored', { name, causes: value.causes.length, measures: value.measures.length }), kept && t('catalogue.old_stays', { old, reason: kept })].filter(Boolean).join(' ');
    await this.listing.run();
  }, () => this.#text);

  /** Says at its entry what is wrong. */
  #mark(problem) {
    for (const { pointer = '' } of problem.errors ?? []) {
      const [, list, at] = pointer.split('/');
      this.lists[list]?.children[at]?.querySelector('input').setAttribute('aria-invalid', 'true');
    }
    this.form.querySelector('[aria-invalid]')?.focus();
    throw problem;
  }

  async #remove() {
    const { name, tag } = this.#current;
    if (!await confirm(t('catalogue.delete_sure', { name }), t('plans.delete'))) return;
    await removeDocument(pathOf(name), tag);
    this.#before = this.#text;
    await this.#close();
    this.done.textContent = t('catalogue.deleted', { name });
    this.onStored();
  }
}
