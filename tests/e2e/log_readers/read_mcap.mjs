// Opens a log with the MCAP project's own reader, decodes its messages with the schema that stands in the log, and
// compares every value with the CSV export of the same log. Doubles must have the same bits.
//
//   node read_mcap.mjs LOG CSV_FOLDER closed|killed
//
// closed: through the index at the end of the file; killed: record by record, from a file without an end.

import { readFileSync } from "node:fs";
import { open } from "node:fs/promises";
import { join } from "node:path";

const SKIP = 77;

async function libraries() {
  try {
    return {
      ...(await import("@mcap/core")),
      ...(await import("@mcap/support")),
      ...(await import("@foxglove/omgidl-parser")),
      ...(await import("@foxglove/omgidl-serialization")),
    };
  } catch (error) {
    if (error.code !== "ERR_MODULE_NOT_FOUND") throw error;
    console.log(`skipped: npm packages are not installed (${error.message})`);
    process.exit(SKIP);
  }
}

/** The table of a CSV file (RFC 4180): { columns, rows }. */
function readCsv(path) {
  const text = readFileSync(path, "utf8");
  const rows = [];
  let row = [];
  let at = 0;
  while (at < text.length) {
    let cell = "";
    if (text[at] === '"') {
      for (at += 1; ; at += 1) {
        if (text[at] === '"' && text[at + 1] !== '"') break;
        if (text[at] === '"') at += 1;
        cell += text[at];
      }
      at += 1;
    } else {
      const begin = at;
      while (text[at] !== "," && text[at] !== "\n") at += 1;
      cell = text.slice(begin, at);
    }
    row.push(cell);
    if (text[at] === "\n") {
      rows.push(row);
      row = [];
    }
    at += 1;
  }
  return { columns: rows.shift(), rows };
}

const AXES = {
  3: ["x", "y", "z"],
  4: ["w", "x", "y", "z"],
  6: ["xy", "xz", "yx", "yz", "zx", "zy"],
  9: ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"],
};

/** What the column `path` of a CSV row stands for in a decoded message, with the enum it belongs to. */
function valueAt(message, path, typeName, definitions) {
  let value = message;
  let type = typeName;
  let enumType;
  for (const part of path.split(".")) {
    if (value === undefined) return {};
    if (Array.isArray(value) || ArrayBuffer.isView(value)) {
      if (part === "count") return { value: value.length };
      const axis = /^\d+$/.test(part) ? Number(part) : AXES[value.length].indexOf(part);
      if (axis < 0) throw new Error(`no element ${part} of ${path}`);
      value = value[axis];
      continue;
    }
    const field = definitions.get(type).definitions.find((d) => d.name === part);
    if (field === undefined) throw new Error(`${type} has no ${part}`);
    value = value[part];
    enumType = field.enumType;
    type = field.type;
  }
  return { value, enumType };
}

function parseDouble(text) {
  const special = { nan: NaN, "-nan": NaN, inf: Infinity, "-inf": -Infinity };
  return text in special ? special[text] : Number(text);
}

function agrees({ value, enumType }, text, definitions) {
  if (value === undefined) return text === "";
  if (enumType !== undefined) {
    const name = definitions.get(enumType).definitions.find((d) => d.value === value)?.name;
    return name !== undefined && name.toLowerCase().endsWith(`_${text}`);
  }
  if (typeof value === "bigint") return value === BigInt(text);
  if (typeof value === "boolean") return text === (value ? "1" : "0");
  if (typeof value === "string") return value === text;
  if (value instanceof Uint8Array) return Buffer.from(value).toString("hex") === text;
  return Object.is(value, parseDouble(text));
}

/** Yields { topic, schema, data } of every message of a log that was closed. */
async function* closedMessages({ McapIndexedReader }, path, decompressHandlers) {
  const file = await open(path, "r");
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      await file.read({ buffer, position: Number(offset) });
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    yield { topic: channel.topic, schema: reader.schemasById.get(channel.schemaId), data: message.data };
  }
  for await (const metadata of reader.readMetadata()) console.log("metadata", metadata.name, metadata.metadata);
  if (reader.statistics.messageCount === 0n) throw new Error("the summary counts no messages");
  await file.close();
}

/** The same of a log that ends without a footer. */
async function* killedMessages({ McapStreamReader }, path, decompressHandlers) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(readFileSync(path));
  const schemas = new Map();
  const channels = new Map();
  for (let record; (record = reader.nextRecord()) !== undefined; ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    yield { topic: channel.topic, schema: schemas.get(channel.schemaId), data: record.data };
  }
}

/** Compares the messages of one topic, one after the other, with the rows of its CSV file. */
class TopicCheck {
  constructor({ parseIDL, MessageReader }, topic, schema, folder) {
    if (schema.encoding !== "omgidl") throw new Error(`${topic}: encoding ${schema.encoding}`);
    const definitions = parseIDL(new TextDecoder().decode(schema.data));
    this.type = schema.name;
    this.definitions = new Map(definitions.map((d) => [d.name, d]));
    this.reader = new MessageReader(schema.name, definitions);
    this.table = readCsv(join(folder, `${topic.replaceAll("/", "_")}.csv`));
    this.topic = topic;
    this.count = 0;
    this.values = 0;
  }

  add(data) {
    const message = this.reader.readMessage(data);
    const row = this.table.rows[this.count];
    if (row === undefined) throw new Error(`${this.topic}: more messages than rows`);
    this.table.columns.forEach((column, i) => {
      const found = valueAt(message, column, this.type, this.definitions);
      if (!agrees(found, row[i], this.definitions)) {
        throw new Error(`${this.topic} row ${this.count} ${column}: ${String(found.value)} in the log, ${row[i]} in CSV`);
      }
      this.values += 1;
    });
    this.count += 1;
  }

  finish() {
    if (this.count !== this.table.rows.length) {
      throw new Error(`${this.topic}: ${this.count} messages, ${this.table.rows.length} rows`);
    }
    console.log(`${this.topic}: ${this.count} messages, ${this.values} values agree`);
  }
}

const [log, folder, kind] = process.argv.slice(2);
const library = await libraries();
const messages = kind === "killed" ? killedMessages : closedMessages;
const topics = new Map();
for await (const { topic, schema, data } of messages(library, log, await library.loadDecompressHandlers())) {
  if (!topics.has(topic)) topics.set(topic, new TopicCheck(library, topic, schema, folder));
  topics.get(topic).add(data);
}
if (topics.size === 0) throw new Error("the log holds no messages");
for (const check of topics.values()) check.finish();
