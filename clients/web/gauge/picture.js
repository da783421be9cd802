/** The picture that a plan has of a characteristic. The address of an image carries no key: with one the file is fetched, and drawn. */

import { get, keyInUse, url } from '../api.js';
import { h } from '../dom.js';
import { t } from '../i18n.js';

let shown = {};

/** Its element, the same as long as characteristic and key are; null without a picture. It is hidden until the picture is there. */
export function pictureOf(one) {
  if (!one?.picture) return null;
  const key = keyInUse();
  if (shown.one !== one || shown.key !== key) shown = { one, key, element: elementOf(one, key) };
  return shown.element;
}

function elementOf({ name, picture }, key) {
  const path = url(['files', ...picture.split('/')]);
  const label = t('panel.picture', { name });
  if (!key) {
    const image = h('img.picture', { alt: label, hidden: true, onload: () => { image.hidden = false; }, src: path });
    return image;
  }
  const canvas = h('canvas.picture', { role: 'img', 'aria-label': label, hidden: true });
  draw(canvas, path).catch(() => {}); // the value is measured without it too
  return canvas;
}

/** The page's policy lets no image be made of bytes, but a canvas. */
async function draw(canvas, path) {
  const image = await createImageBitmap(await (await get(path, { asks: false })).blob());
  Object.assign(canvas, { width: image.width, height: image.height, hidden: false });
  canvas.getContext('2d').drawImage(image, 0, 0);
}
