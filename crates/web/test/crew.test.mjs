// A worker that is at an older wish while a newer one waits. No browser: a worker of our own, which only notes what it is sent.
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
  says(data) {
    this.onmessage({ data });
  }
}
globalThis.Worker = Noting;
prepare('', pack(Buffer.from('module')).toString('base64'));
/** Until the module is unpacked and the last worker has that many messages. */
const sent = async (messages) => {
  const from = performance.now();
  const waits = () => workers.at(-1).posted.length < messages && performance.now() - from < 10e3;
  for (let i = 0; i < 20 || waits(); i++) await new Promise((go) => setImmediate(go));
};
const run = (id) => ({ kind: 'run', id });
/** A crew whose worker has begun the first wish. */
const atWork = async () => {
  mock.timers.enable({ apis: ['setTimeout'] });
  const crew = hire({});
  crew.ask(run(1));
  await sent(2);
  workers[0].says({ kind: 'begun', id: 1 });
  return crew;
};

beforeEach(() => {
  workers = [];
  mock.timers.reset();
});

test('a worker that stays at an older wish is ended, and another gets the newest', async () => {
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

test('one that comes to the newest in time goes on', async () => {
  const crew = await atWork();
  crew.ask(run(2));
  workers[0].says({ kind: 'begun', id: 2 });
  mock.timers.tick(10_000);
  await sent(0);
  assert.deepEqual([workers.length, workers[0].ended], [1, false]);
  // Nor is one ended that has nothing to do.
  workers[0].says({ kind: 'settled', id: 2 });
  crew.ask(run(3));
  mock.timers.tick(10_000);
  assert.equal(workers[0].ended, false);
});

test('what is packed comes back', () => {
  const bytes = Uint8Array.from({ length: 300_000 }, (_, n) => (n * n) >> (n % 13));
  const packed = new Uint8Array(pack(bytes));
  assert.ok(packed.length < bytes.length);
  assert.deepEqual(new Uint8Array(unpacked(packed)), bytes);
});
