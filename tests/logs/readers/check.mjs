// Reads a mission with Foxglove's JavaScript reader: `npm install && node check.mjs RUN`, by hand.
// Decodes every message by the schema in the file and holds the outcome against outcome.json.
import assert from "node:assert/strict";
import { open, readFile } from "node:fs/promises";
import path from "node:path";
import { McapIndexedReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor/index.js";

const run = process.argv[2];
if (run === undefined) {
  console.error("usage: node check.mjs RUN, a folder that a mission left");
  process.exit(2);
}
const file = await open(path.join(run, "mission.mcap"));
const reader = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(file),
  decompressHandlers: await loadDecompressHandlers(),
});

const types = new Map();
for (const schema of reader.schemasById.values()) {
  assert.equal(schema.encoding, "protobuf");
  const root = protobuf.Root.fromDescriptor(descriptor.FileDescriptorSet.decode(schema.data));
  types.set(schema.id, root.lookupType(schema.name));
}

const counts = new Map();
let latest = 0n;
let outcome;
for await (const message of reader.readMessages()) {
  const { topic, schemaId } = reader.channelsById.get(message.channelId);
  const decoded = types.get(schemaId).decode(message.data);
  assert(message.logTime >= latest, `${topic} goes back in time`);
  latest = message.logTime;
  counts.set(topic, (counts.get(topic) ?? 0) + 1);
  if (topic === "/outcome") outcome = decoded.toJSON();
}
for await (const attachment of reader.readAttachments()) {
  console.log(`attachment ${attachment.name}, ${attachment.data.byteLength} bytes`);
}
await file.close();

for (const [topic, count] of [...counts].sort()) console.log(`${String(count).padStart(6)} ${topic}`);
const kept = JSON.parse(await readFile(path.join(run, "outcome.json"), "utf8"));
for (const key of ["command", "status", "reason"]) assert.equal(outcome[key], kept[key], key);
assert.deepEqual(outcome.visited ?? [], kept.visited);
console.log(`outcome as in outcome.json: ${outcome.status}`);
