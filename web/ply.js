// Reads the PLY files of a map: little-endian points with a colour, and triangles.

const SIZES = { float: 4, uchar: 1 };

/** {positions: Float32Array of x y z [m], colours: Uint8Array of r g b, indices: Uint32Array of triangles}. */
export function readPly(buffer) {
  const { header, begin } = headerOf(buffer);
  const count = Number(header.match(/element vertex (\d+)/)?.[1] ?? 0);
  const faces = Number(header.match(/element face (\d+)/)?.[1] ?? 0);
  const stride = [...header.matchAll(/property (float|uchar) \w+/g)].reduce((sum, [, type]) => sum + SIZES[type], 0);
  if (!header.includes('binary_little_endian') || stride !== 15) throw new Error('This file has no points with colours.');
  const view = new DataView(buffer, begin), positions = new Float32Array(3 * count), colours = new Uint8Array(3 * count);
  for (let i = 0; i < count; ++i) {
    for (let axis = 0; axis < 3; ++axis) {
      positions[3 * i + axis] = view.getFloat32(stride * i + 4 * axis, true);
      colours[3 * i + axis] = view.getUint8(stride * i + 12 + axis);
    }
  }
  return { positions, colours, indices: trianglesOf(view, stride * count, faces) };
}

function headerOf(buffer) {
  const text = new TextDecoder('latin1').decode(new Uint8Array(buffer, 0, Math.min(2000, buffer.byteLength)));
  const end = text.indexOf('end_header\n');
  if (!text.startsWith('ply') || end < 0) throw new Error('This is no PLY file.');
  return { header: text.slice(0, end), begin: end + 'end_header\n'.length };
}

function trianglesOf(view, begin, faces) {
  const indices = new Uint32Array(3 * faces), stride = 13; // a count of one byte, then three numbers
  for (let i = 0; i < faces; ++i)
    for (let corner = 0; corner < 3; ++corner)
      indices[3 * i + corner] = view.getInt32(begin + stride * i + 1 + 4 * corner, true);
  return indices;
}
