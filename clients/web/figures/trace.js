/** The moves of a run: coordinates in typed arrays, straight from the bytes; a move is an object only when it is asked for. */

export const KINDS = ['rapid', 'feed', 'arc', 'probe'];
const AXES = ['X', 'Y', 'Z'];

const bytesOf = (text) => new TextEncoder().encode(text);
const HEAD = bytesOf('{"moves":[\n');
const TAIL = bytesOf('\n],"dropped"');
const FIRST = { line: bytesOf('"line":'), program: bytesOf('"program":"'), start: bytesOf('"start_mm":{'), end: bytesOf('"end_mm":{'), contact: bytesOf('"contact_mm":') };
const [NEWLINE, QUOTE, BACKSLASH, COLON, MINUS, POINT, BRACE, ZERO, EXPONENT] = bytesOf('\n"\\:-.{0e');

export class Trace {
  /** @param bytes the JSON of the service, which has one move a line; any other JSON of a trace is read too */
  constructor(bytes) {
    this.bytes = bytes;
    this.programs = [];
    const begins = HEAD.every((byte, i) => bytes[i] === byte) ? startsOf(bytes) : null;
    const { moves, blocks } = begins ? tailOf(bytes, begins.at(-1)) : JSON.parse(new TextDecoder().decode(bytes));
    /** Of a run that watched parameters: each block as it ran. */
    this.blocks = blocks ?? null;
    this.length = begins ? begins.length - 1 : moves.length;
    this.kinds = new Uint8Array(this.length);
    this.lines = new Int32Array(this.length);
    this.programAt = new Uint16Array(this.length);
    /** Six numbers a move: start and end. */
    this.ends = new Float32Array(6 * this.length);
    this.contacts = [];
    if (begins) this.#scan(begins);
    else moves.forEach((move, i) => this.#put(i, move));
    this.at = begins
      ? (i) => JSON.parse(new TextDecoder().decode(bytes.subarray(begins[i], begins[i + 1] - (i + 1 < this.length ? 2 : 1))))
      : (i) => moves[i];
    /** Three numbers a contact. */
    this.contacts = Float32Array.from(this.contacts);
  }

  /** {kind: the coordinates of both ends of its moves} */
  get endsByKind() {
    const counts = KINDS.map(() => 0);
    for (const kind of this.kinds) ++counts[kind];
    const ends = counts.map((count) => new Float32Array(6 * count));
    counts.fill(0);
    for (let i = 0; i < this.length; ++i) {
      const kind = this.kinds[i];
      const to = 6 * counts[kind]++;
      for (let k = 0; k < 6; ++k) ends[kind][to + k] = this.ends[6 * i + k];
    }
    return Object.fromEntries(KINDS.map((name, kind) => [name, ends[kind]]));
  }

  /** The first move from `first` on that a line of a program commands; -1 without one. @param isOf tells by its path */
  indexOf(line, isOf, first = 0) {
    const wanted = this.programs.map(isOf);
    for (let i = first; i < this.length; ++i) if (this.lines[i] === line && wanted[this.programAt[i]]) return i;
    return -1;
  }

  #program(name) {
    const known = this.programs.lastIndexOf(name);
    return known >= 0 ? known : this.programs.push(name) - 1;
  }

  #put(i, { kind, line, program, start_mm: start, end_mm: end, contact_mm: contact }) {
    this.kinds[i] = KINDS.indexOf(kind);
    this.lines[i] = line;
    this.programAt[i] = this.#program(program);
    AXES.forEach((axis, k) => {
      this.ends[6 * i + k] = start[axis];
      this.ends[6 * i + 3 + k] = end[axis];
      if (contact) this.contacts.push(contact[axis]);
    });
  }

  #scan(begins) {
    const { bytes } = this;
    const kinds = Object.fromEntries(KINDS.map((name, kind) => [name.charCodeAt(0), kind]));
    const scanner = new Scanner(bytes);
    let last = { from: 0, length: -1, at: 0 };
    for (let i = 0; i < this.length; ++i) {
      this.kinds[i] = kinds[bytes[begins[i] + '{"kind":"'.length]];
      scanner.at = begins[i];
      scanner.seek(FIRST.line);
      this.lines[i] = scanner.number();
      scanner.seek(FIRST.program);
      const from = scanner.at;
      const length = endOfText(bytes, from) - from;
      if (!isSame(bytes, from, length, last)) {
        last = { from, length, at: this.#program(JSON.parse(`"${new TextDecoder().decode(bytes.subarray(from, from + length))}"`)) };
      }
      this.programAt[i] = last.at;
      scanner.seek(FIRST.start);
      for (let k = 0; k < 3; ++k) this.ends[6 * i + k] = scanner.member();
      scanner.seek(FIRST.end);
      for (let k = 3; k < 6; ++k) this.ends[6 * i + k] = scanner.member();
      scanner.seek(FIRST.contact);
      if (bytes[scanner.at] === BRACE) for (let k = 0; k < 3; ++k) this.contacts.push(scanner.member());
    }
  }
}

/** Where each move begins; behind them where the list ends. */
function startsOf(bytes) {
  const tail = bytes.lastIndexOf(NEWLINE);
  const starts = [];
  for (let at = HEAD.length; at < tail; at = bytes.indexOf(NEWLINE, at) + 1) starts.push(at);
  return TAIL.every((byte, i) => bytes[tail + i] === byte) ? [...starts, tail + 1] : null;
}

/** What stands behind the moves. @param from the bracket that ends their list */
const tailOf = (bytes, from) => JSON.parse(`{${new TextDecoder().decode(bytes.subarray(from + 2))}`);

/** The quote that ends a text of JSON. */
function endOfText(bytes, from) {
  for (let at = from; ; ++at) {
    if (bytes[at] === BACKSLASH) ++at;
    else if (bytes[at] === QUOTE) return at;
  }
}

function isSame(bytes, from, length, other) {
  if (length !== other.length) return false;
  for (let k = 0; k < length; ++k) if (bytes[from + k] !== bytes[other.from + k]) return false;
  return true;
}

/** Goes forward through JSON whose members come in a known order. */
class Scanner {
  at = 0;

  constructor(bytes) {
    this.bytes = bytes;
  }

  /** Goes behind the next place of a key. */
  seek(key) {
    const { bytes } = this;
    for (let at = this.at; ; ++at) {
      let k = 0;
      while (k < key.length && bytes[at + k] === key[k]) ++k;
      if (k < key.length) continue;
      this.at = at + k;
      return;
    }
  }

  /** The number behind the next colon. */
  member() {
    while (this.bytes[this.at] !== COLON) ++this.at;
    ++this.at;
    return this.number();
  }

  number() {
    const { bytes } = this;
    const from = this.at;
    const sign = bytes[this.at] === MINUS ? -1 : 1;
    if (sign < 0) ++this.at;
    let digits = 0;
    let scale = 1;
    let isFraction = false;
    for (;; ++this.at) {
      const byte = bytes[this.at];
      if (byte === POINT) isFraction = true;
      else if (byte >= ZERO && byte <= ZERO + 9) {
        digits = 10 * digits + byte - ZERO;
        if (isFraction) scale *= 10;
      } else break;
    }
    if ((bytes[this.at] | 0x20) !== EXPONENT) return sign * digits / scale;
    while (!',}'.includes(String.fromCharCode(bytes[this.at]))) ++this.at;
    return Number(new TextDecoder().decode(bytes.subarray(from, this.at)));
  }
}
