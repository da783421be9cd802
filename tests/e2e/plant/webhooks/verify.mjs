// Reads {"secret", "headers", "body"} a line; says of each whether both packages accept it, and accept none of its
// forgeries: a changed body, id, time or signature.
import { createInterface } from 'node:readline'
import * as standard from 'standardwebhooks'
import * as svix from 'svix'

function accepts(Webhook, secret, body, headers) {
  try {
    const event = new Webhook(secret).verify(body, headers) // svix gives nothing back
    return event === undefined || JSON.stringify(event) === JSON.stringify(JSON.parse(body))
  } catch {
    return false
  }
}

for await (const line of createInterface({ input: process.stdin })) {
  const { secret, headers, body } = JSON.parse(line)
  for (const [name, { Webhook }] of Object.entries({ standard, svix })) {
    const good = accepts(Webhook, secret, body, headers)
    const forged = [
      accepts(Webhook, secret, body.replace('25', '26'), headers),
      accepts(Webhook, secret, body, { ...headers, 'webhook-id': headers['webhook-id'] + '0' }),
      accepts(Webhook, secret, body, { ...headers, 'webhook-timestamp': String(+headers['webhook-timestamp'] + 1) }),
      accepts(Webhook, secret, body, { ...headers, 'webhook-signature': 'v1,' + 'A'.repeat(43) + '=' }),
    ]
    console.log(name, good && !forged.includes(true) ? 'ok' : 'WRONG')
  }
}
