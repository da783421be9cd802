/** A sound for each verdict, for those whose eyes are on the part. Off until it is switched on. */

import { h } from '../dom.js';
import { t } from '../i18n.js';
import { readStored, store } from '../stored.js';

const KEPT = 'sound';
const GAP_S = 0.06;
const LOUD = 0.4;
/** [Hz, seconds] in a row: high and single is good, low and twice is not. */
const TONES = {
  good: [[880, 0.14]], rework: [[330, 0.18], [440, 0.18]], reject: [[196, 0.3], [196, 0.3]], indeterminate: [[440, 0.18], [330, 0.18]],
};
let context;

const soundIsOn = () => readStored(KEPT) === 'on';

/** A browser lets a page sound from a touch on: switching on is one. */
export const soundChoice = () => h('label.choice', h('input', { type: 'checkbox', name: 'sound', checked: soundIsOn(), onchange: ({ target }) => {
  store(KEPT, target.checked ? 'on' : 'off');
  if (target.checked) play('good');
} }), h('span', t('job.sound')));

export function sound(verdict) {
  if (soundIsOn()) play(verdict);
}

function play(verdict) {
  if (!globalThis.AudioContext) return;
  context ??= new AudioContext();
  context.resume();
  let at = context.currentTime;
  for (const [hertz, seconds] of TONES[verdict]) {
    const tone = context.createOscillator();
    const volume = context.createGain();
    tone.frequency.value = hertz;
    volume.gain.setValueAtTime(LOUD, at);
    volume.gain.exponentialRampToValueAtTime(0.001, at + seconds);
    tone.connect(volume).connect(context.destination);
    tone.start(at);
    tone.stop(at + seconds);
    at += seconds + GAP_S;
  }
}
