// Reads a payload in base64 a line; prints what the package of the Eclipse Foundation reads in it, as JSON.
import { createInterface } from 'node:readline'
import sparkplug from 'sparkplug-payload'

const reader = sparkplug.get('spBv1.0')
for await (const line of createInterface({ input: process.stdin })) {
  const payload = reader.decodePayload(Buffer.from(line, 'base64'))
  console.log(JSON.stringify(payload, (_, value) => (value && value.low !== undefined && value.toString ? Number(value.toString()) : value)))
}
