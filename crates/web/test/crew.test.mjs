// A worker that computes an older request while a newer one waits. Without a browser: the worker here only records its messages.
import assert from 'node:assert/strict';
import { beforeEach, mock, test } from 'node:test';
import { hire, prepare, unpacked } from '../page/src/crew.js';
import { pack } from '../page/pack.mjs';

let workers;
class Noting {
  constructor() {
    workers.push(this);
    [this.posted, this.ended] = [[], false];
  }
  postMessage(message) {
    this.posted.push(message);
  }
  terminate() {
    this.ended = true;
  }
  send(data) {
    this.onmessage({ data });
  }
}
globalThis.Worker = Noting;
prepare('', pack(Buffer.from('module')).toString('base64'));
/** Waits until the module is unpacked and the last worker has this number of messages. */
const sent = async (messages) => {
  const from = performance.now();
  const waits = () => workers.at(-1).posted.length < messages && performance.now() - from < 10e3;
  for (let i = 0; i < 20 || waits(); i++) await new Promise((go) => setImmediate(go));
};
const run = (id) => ({ kind: 'run', id });
/** A crew whose worker has begun the first request. */
const atWork = async () => {
  mock.timers.enable({ apis: ['setTimeout'] });
  const crew = hire({});
  crew.ask(run(1));
  await sent(2);
  workers[0].send({ kind: 'begun', id: 1 });
  return crew;
};

beforeEach(() => {
  workers = [];
  mock.timers.reset();
});

test('a worker that stays at an older request is terminated, and another gets the newest', async () => {
  const crew = await atWork();
  crew.ask(run(2));
  crew.ask(run(3));
  await sent(0);
  mock.timers.tick(999);
  assert.equal(workers[0].ended, false);
  mock.timers.tick(1);
  await sent(2);
  assert.equal(workers[0].ended, true);
  assert.deepEqual(workers[1].posted.map(({ kind, id }) => [kind, id]), [['begin', undefined], ['run', 3]]);
});

test('a worker that reaches the newest request in time goes on', async () => {
  const crew = await atWork();
  crew.ask(run(2));
  workers[0].send({ kind: 'begun', id: 2 });
  mock.timers.tick(10_000);
  await sent(0);
  assert.deepEqual([workers.length, workers[0].ended], [1, false]);
  // An idle worker is not terminated.
  workers[0].send({ kind: 'settled', id: 2 });
  crew.ask(run(3));
  mock.timers.tick(10_000);
  assert.equal(workers[0].ended, false);
});

test('unpacking restores the packed bytes', () => {
  const bytes = Uint8Array.from({ length: 300_000 }, (_, n) => (n * n) >> (n % 13));
  const packed = new Uint8Array(pack(bytes));
  assert.ok(packed.length < bytes.length);
  assert.deepEqual(new Uint8Array(unpacked(packed)), bytes);
});
