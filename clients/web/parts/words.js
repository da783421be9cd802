/** What somebody types or scans into a dialog: a value is no reason and no name, and neither is the scan of something else. */

import { h } from '../dom.js';
import { isBadge } from '../gauge/badge.js';
import { keptPrefixes } from '../gauge/prefixes.js';
import { BurstWatch, isReading, nameIn, notWords } from '../gauge/reading.js';
import { t } from '../i18n.js';

const bursts = new WeakMap();

/** A field for words, whose keys tell a scan. */
export function wordField(attributes = {}) {
  const burst = new BurstWatch();
  const input = h('input', {
    type: 'text', maxlength: 200, autocomplete: 'off', spellcheck: 'false', ...attributes,
    onfocus: () => burst.reset(), oninput: () => input.value || burst.reset(), onkeydown: ({ key, timeStamp }) => { if (key.length === 1) burst.key(timeStamp); },
  });
  bursts.set(input, burst);
  return input;
}

/** Why what stands in such a field is no words; '' where it is, or its list offers it. */
export function refusedWords(input) {
  const typed = input.value.trim();
  if (!typed || [...input.list?.options ?? []].some(({ value }) => value === typed)) return '';
  // A badge is a secret: it is not repeated.
  const found = isBadge(typed) ? 'scan' : notWords(typed, { burst: bursts.get(input).isBurst(typed), prefixes: keptPrefixes() });
  return found && t(`words.${found}`, { typed });
}

/** The name in a field of one: {name}, '' where there is none, or {why} it is no such name. @param limits of the record that it goes to */
export function nameOf({ value }, field, limits) {
  const typed = value.trim();
  const name = isBadge(typed) ? null : nameIn(typed, field, keptPrefixes());
  if (name === null) return { why: t('words.scan') };
  return isReading(name, { limits }) ? { why: t('entry.reading', { typed }) } : { name };
}
