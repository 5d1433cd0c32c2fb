// Broadcast as node's `ws` documents it.
//   node ws_broadcast.mjs MESSAGES_PER_SECOND BYTES
import { WebSocket, WebSocketServer } from 'ws';

const rate = Number(process.argv[2] ?? 25);
const bytes = Math.max(16, Number(process.argv[3] ?? 64));
const server = new WebSocketServer({ host: '127.0.0.1', port: 0, perMessageDeflate: false, backlog: 4096 });
server.on('listening', () => console.log(`listening on http://127.0.0.1:${server.address().port}`));

let sequence = 0n;
let due = performance.now();
const tick = () => {
  const message = Buffer.alloc(bytes);
  message.writeBigUInt64LE(++sequence, 0);
  message.writeBigInt64LE(process.hrtime.bigint(), 8); // the monotonic clock
  for (const client of server.clients) {
    if (client.readyState === WebSocket.OPEN) client.send(message);
  }
  due += 1000 / rate;
  setTimeout(tick, Math.max(0, due - performance.now()));
};
setTimeout(tick, 1000 / rate);
process.on('SIGTERM', () => process.exit(0));
