// omnimapper-serve as a child of the test.
import { spawn } from 'node:child_process';

/** Starts the server of a map and waits until it says where the page is; `port` 0 takes a free one. */
export async function startServer(program, map, port, options = []) {
  const child = spawn(program, [map, '--port', String(port), ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
  const ended = new Promise((resolve) => child.on('close', resolve));
  const address = await new Promise((resolve, reject) => {
    let said = '';
    const read = (text) => {
      said += text;
      const found = said.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    };
    child.stdout.on('data', read);
    child.stderr.on('data', read);
    ended.then((code) => reject(new Error(`omnimapper-serve ended with code ${code}: ${said}`)));
  });
  const kill = async (signal) => {
    child.kill(signal);
    await ended;
  };
  return { address, port: Number(new URL(address).port), kill };
}
