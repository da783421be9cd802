/** The code on a certificate, read by a reader that others wrote, also where dirt hides some of it. */

import assert from 'node:assert/strict';
import path from 'node:path';
import { describe, it } from 'node:test';

import { read } from './support/qr_reader.mjs';

const { qrModules } = await import(path.resolve('clients/web/parts/qr_code.js'));

describe('a QR code', () => {
  // As much as each version holds with correction M (ISO/IEC 18004, table 7).
  const MOST = [14, 26, 42, 62, 84, 106, 122, 152, 180, 213];
  for (const [i, most] of MOST.entries()) {
    it(`of version ${i + 1} is read, clean and dirty`, () => {
      const text = 'https://gauge.example/v1/measurements/m17-0123456789abcdef/proof?'.repeat(4).slice(0, most);
      const modules = qrModules(text);
      assert.equal(modules.length, 17 + 4 * (i + 1));
      assert.deepEqual([read(modules).data, read(modules).version], [text, i + 1]);
      // A spot away from finders, format and clock: less than the 15 % that M bears, more than chance.
      const spot = Math.floor(modules.length / 8);
      const from = modules.length - 9 - spot;
      for (let y = from; y < from + spot; ++y) for (let x = from; x < from + spot; ++x) modules[y][x] = !modules[y][x];
      assert.equal(read(modules)?.data, text);
    });
  }

  it('is UTF-8, and none where the text is too long', () => {
    assert.equal(read(qrModules('größer als 25 µm')).data, 'größer als 25 µm');
    assert.equal(qrModules('x'.repeat(214)), null);
  });

  it('that is damaged too much is not read: the reader judges', () => {
    const modules = qrModules('https://gauge.example/v1/measurements/m17/proof').map((row, y) => row.map((dark, x) => (y > 9 && x > 9 ? !dark : dark)));
    assert.notEqual(read(modules)?.data, 'https://gauge.example/v1/measurements/m17/proof');
  });
});
