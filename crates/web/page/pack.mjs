// The module, packed: LZMA makes the page a quarter smaller than gzip does. `unpacked` of src/crew.js is the inverse.
import { execFileSync } from 'node:child_process';

/** Node has no LZMA; Python's is that of the xz tools. Python leaves the length in the header open; here it is inserted. */
const PACK = `import lzma, sys
plain = sys.stdin.buffer.read()
filters = [{"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME, "dict_size": 1 << 22, "lc": 4, "pb": 0}]
packed = lzma.compress(plain, lzma.FORMAT_ALONE, filters=filters)
sys.stdout.buffer.write(packed[:5] + len(plain).to_bytes(8, "little") + packed[13:])`;

export const pack = (bytes) => execFileSync('python3', ['-c', PACK], { input: bytes, maxBuffer: 1 << 28 });
