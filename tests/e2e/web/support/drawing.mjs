/** STEP drawings and XLSX workbooks that tests make, and how they are dropped on the page. */

import zlib from 'node:zlib';

const FRAME = [
  "#1=PRODUCT('PART','','',(#2));", "#2=PRODUCT_CONTEXT('',#3,'');", "#3=APPLICATION_CONTEXT('managed model based 3d engineering');",
  "#4=PRODUCT_DEFINITION_SHAPE('','',$);", '#5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));',
  "#6=CARTESIAN_POINT('',(0.,0.,0.));", "#7=DIRECTION('',(0.,0.,1.));", "#8=AXIS2_PLACEMENT_3D('',#6,#7,$);",
];
const length = (id, mm) => `#${id}=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(${mm.toFixed(6)}),#5);`;

/** The entities of a diameter from one on: a class such as H7, or deviations in mm as [lower, upper]. */
function diameter(at, { name, nominal, of, deviations, inside }) {
  const [, letter, grade] = /^([A-Za-z]+)(\d+)$/.exec(of ?? '') ?? [];
  const tolerance = of ? [`#${at + 9}=LIMITS_AND_FITS('${letter}','${inside ? 'hole' : 'shaft'}','${grade}','');`]
    : [`#${at + 9}=TOLERANCE_VALUE(#${at + 12},#${at + 13});`, ...deviations.map((mm, i) => length(at + 12 + i, mm))];
  return [
    `#${at}=DIMENSIONAL_SIZE(#${at + 1},'diameter');`, `#${at + 1}=SHAPE_ASPECT('','',#4,.T.);`, `#${at + 2}=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#${at + 1},#4,#${at + 3});`,
    `#${at + 3}=ADVANCED_FACE('',(),#${at + 4},${inside ? '.F.' : '.T.'});`, `#${at + 4}=CYLINDRICAL_SURFACE('',#8,${(nominal / 2).toFixed(4)});`,
    `#${at + 5}=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#${at},#${at + 6});`, `#${at + 6}=SHAPE_DIMENSION_REPRESENTATION('',(#${at + 7}),$);`,
    `#${at + 7}=MEASURE_REPRESENTATION_ITEM('nominal value',LENGTH_MEASURE(${nominal.toFixed(4)}),#5);`, `#${at + 8}=PLUS_MINUS_TOLERANCE(#${at + 9},#${at});`,
    ...tolerance, `#${at + 10}=DRAUGHTING_CALLOUT('${name}',());`, `#${at + 11}=DRAUGHTING_MODEL_ITEM_ASSOCIATION('','',#${at},$,#${at + 10});`,
  ];
}

/** A drawing of diameters: [{name, nominal, of or deviations, inside}]. */
export function drawingOf(part, sizes) {
  const data = [...FRAME.map((line) => line.replace('PART', part)), ...sizes.flatMap((size, i) => diameter(100 + 20 * i, size))];
  return `ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('${part}.stp','2026-11-20T08:00:00',(''),(''),'','','');\n`
    + `FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 3 1 4 }'));\nENDSEC;\nDATA;\n${data.join('\n')}\nENDSEC;\nEND-ISO-10303-21;\n`;
}

/** So many sizes of a housing; the first is a bore of 25 H7. */
export const housing = (count) => Array.from({ length: count }, (_, i) => {
  const inside = i % 2 === 0;
  return { name: `${inside ? 'Bore' : 'Journal'} ${i + 1}`, nominal: 25 + i, inside, ...(i % 6 === 5 ? { deviations: [-0.05, 0.05] } : { of: inside ? 'H7' : 'g6' }) };
});

/** Drops a file on the view, as somebody does with the mouse. */
export async function dropFile(page, name, text) {
  const dataTransfer = await page.evaluateHandle(([called, content]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([content], called));
    return transfer;
  }, [name, text]);
  for (const event of ['dragover', 'drop']) await page.dispatchEvent('.desk.plans', event, { dataTransfer });
}

/** A workbook of one sheet, as spreadsheets write it: shared texts, numbers, packed. */
export function workbookOf(rows) {
  const texts = [...new Set(rows.flat().filter((cell) => typeof cell === 'string'))];
  const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
  const cell = (value, column, row) => {
    const place = `r="${String.fromCharCode(65 + column)}${row + 1}"`;
    return typeof value === 'string' ? `<c ${place} t="s"><v>${texts.indexOf(value)}</v></c>` : `<c ${place}><v>${value}</v></c>`;
  };
  const main = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"';
  const files = {
    'xl/workbook.xml': `<workbook ${main} xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets><sheet name="A" sheetId="1" r:id="rId7"/></sheets></workbook>`,
    'xl/_rels/workbook.xml.rels': '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rId7" Type="" Target="worksheets/sheet1.xml"/></Relationships>',
    'xl/sharedStrings.xml': `<sst ${main}>${texts.map((text) => `<si><t>${escaped(text)}</t></si>`).join('')}</sst>`,
    'xl/worksheets/sheet1.xml': `<worksheet ${main}><sheetData>${rows.map((row, i) =>
      `<row r="${i + 1}">${row.map((value, column) => (value === null ? '' : cell(value, column, i))).join('')}</row>`).join('')}</sheetData></worksheet>`,
  };
  return archive(files);
}

function archive(files) {
  const [bodies, directory] = [[], []];
  let at = 0;
  for (const [name, text] of Object.entries(files)) {
    const packed = zlib.deflateRawSync(text);
    const head = Buffer.alloc(26);
    head.writeUInt16LE(8, 4);
    head.writeUInt32LE(packed.length, 14);
    head.writeUInt32LE(text.length, 18);
    head.writeUInt16LE(name.length, 22);
    bodies.push(Buffer.from('PK\x03\x04', 'latin1'), head, Buffer.from(name), packed);
    const place = Buffer.alloc(16);
    place.writeUInt32LE(at, 12);
    directory.push(Buffer.from('PK\x01\x02\x14\x00', 'latin1'), head.subarray(0, 24), Buffer.from([0, 0]), place.subarray(2), Buffer.from(name));
    at += 30 + name.length + packed.length;
  }
  const entries = Buffer.concat(directory);
  const end = Buffer.alloc(18);
  end.writeUInt16LE(Object.keys(files).length, 6);
  end.writeUInt32LE(entries.length, 8);
  end.writeUInt32LE(at, 12);
  return Buffer.concat([...bodies, entries, Buffer.from('PK\x05\x06', 'latin1'), end]);
}
