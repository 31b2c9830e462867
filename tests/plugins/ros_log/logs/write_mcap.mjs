// Writes OUT.mcap with @mcap/core of npm: node write_mcap.mjs OUT.mcap.
import { McapWriter } from "@mcap/core";
import { writeFileSync } from "node:fs";

const definition = `std_msgs/Header header
float32 angle_min
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges
float32[] intensities
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
`;

// A LaserScan as CDR: the frame "laser" takes 6 bytes and 2 of padding.
function scan(seconds, range) {
  const data = new DataView(new ArrayBuffer(4 + 4 + 4 + 4 + 8 + 7 * 4 + 4 + 5 * 4 + 4));
  let at = 0;
  const uint = (value) => { data.setUint32(at, value, true); at += 4; };
  const real = (value) => { data.setFloat32(at, value, true); at += 4; };
  data.setUint8(1, 1);
  at = 4;
  [seconds, 0, 6].forEach(uint);
  [..."laser"].forEach((letter, i) => data.setUint8(at + i, letter.charCodeAt(0)));
  at += 8;
  [-1, 1, 0.5, 0, 0, 0.1, 30].forEach(real);
  uint(5);
  for (let i = 0; i < 5; ++i) real(range);
  uint(0);
  return new Uint8Array(data.buffer);
}

const parts = [];
let position = 0n;
const writable = {
  position: () => position,
  write: async (bytes) => { parts.push(Buffer.from(bytes)); position += BigInt(bytes.length); },
};
const writer = new McapWriter({ writable, chunkSize: 300 });
await writer.start({ profile: "ros2", library: "" });
const schemaId = await writer.registerSchema({
  name: "sensor_msgs/msg/LaserScan", encoding: "ros2msg", data: new TextEncoder().encode(definition) });
const channelId = await writer.registerChannel({
  schemaId, topic: "/scan", messageEncoding: "cdr", metadata: new Map() });
for (let i = 0; i < 4; ++i) {
  const logTime = BigInt(1600000000 + i) * 1000000000n;
  await writer.addMessage({ channelId, sequence: i, publishTime: logTime, logTime, data: scan(1600000000 + i, 2 + i) });
}
await writer.end();
writeFileSync(process.argv[2], Buffer.concat(parts));
