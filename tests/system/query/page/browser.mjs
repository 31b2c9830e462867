// A Chromium that puppeteer-core drives by pipes, so that no other program can drive it.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';

function transportOf(chromium) {
  const [, , , input, output] = chromium.stdio;
  const transport = {
    send: (message) => input.write(message + '\0'),
    close: () => input.end(),
  };
  let begun = '';
  output.setEncoding('utf8');
  output.on('data', (text) => {
    const messages = (begun + text).split('\0');
    begun = messages.pop();
    for (const message of messages) transport.onmessage?.(message);
  });
  output.on('error', () => {});
  output.on('close', () => transport.onclose?.());
  return transport;
}

/**
 * Starts the browser, which keeps what it must in the folder `profile`. `puppeteerFile` is the build of puppeteer-core
 * for browsers, which lacks what starts one.
 */
export async function startBrowser(puppeteerFile, profile) {
  const chromium = spawn('chromium',
    ['--headless', '--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--no-first-run',
      '--disable-background-networking', '--remote-debugging-pipe', `--user-data-dir=${profile}`, 'about:blank'],
    { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true });
  const ended = new Promise((resolve) => chromium.on('close', resolve));
  // The build for browsers must not see that it runs in Node, where it would look for other packages.
  const puppeteer = new Function('process', readFileSync(puppeteerFile, 'utf8') + '\nreturn Puppeteer;')(undefined);
  const browser = await puppeteer.connect({ transport: transportOf(chromium), defaultViewport: null });
  const stop = async () => {
    await browser.close().catch(() => {});
    try {
      process.kill(-chromium.pid, 'SIGKILL'); // with the processes that it started
    } catch { /* they have ended */ }
    await ended;
  };
  return { browser, stop };
}
