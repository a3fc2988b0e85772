// Messages over pipes: see main.mjs.
import fs from 'node:fs';

const LENGTHS = 8;

export async function* messages(stream) {
    let chunks = [];
    let held = 0;
    let wanted = LENGTHS;
    for await (const chunk of stream) {
        chunks.push(chunk);
        held += chunk.length;
        while (held >= wanted) {
            const bytes = Buffer.concat(chunks);
            chunks = [bytes];
            const [head, data] = [bytes.readUInt32LE(0), bytes.readUInt32LE(4)];
            wanted = LENGTHS + head + data;
            if (held < wanted) break;
            const text = bytes.subarray(LENGTHS, LENGTHS + head).toString('utf8');
            yield { head: JSON.parse(text), data: bytes.subarray(LENGTHS + head, wanted) };
            chunks = [bytes.subarray(wanted)];
            held -= wanted;
            wanted = LENGTHS;
        }
    }
}

export function send(head, parts = []) {
    const text = Buffer.from(JSON.stringify(head), 'utf8');
    const lengths = Buffer.alloc(LENGTHS);
    lengths.writeUInt32LE(text.length, 0);
    lengths.writeUInt32LE(parts.reduce((sum, part) => sum + part.byteLength, 0), 4);
    for (const part of [lengths, text, ...parts]) write(part);
}

function write(part) {
    let rest = Buffer.from(part.buffer ?? part, part.byteOffset ?? 0, part.byteLength);
    while (rest.length > 0) {
        try {
            rest = rest.subarray(fs.writeSync(1, rest));
        } catch (error) {
            if (error.code !== 'EAGAIN') throw error;
        }
    }
}

// The bytes that the JSON points at, as [offset, length].
export const part = (data, [offset, length]) => data.subarray(offset, offset + length);
