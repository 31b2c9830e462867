// Drives the page of a map in a browser as people do. Usage: node drive.mjs PUPPETEER PROGRAMS MAP SCRATCH
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, utimesSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { startBrowser } from './browser.mjs';
import { startServer } from './server.mjs';
import { Visitor } from './Visitor.mjs';

const [puppeteer, programs, map, scratch] = process.argv.slice(2);
const program = join(programs, 'omnimapper-serve');
const commands = join(scratch, 'commands.csv');
const HOSTILE = '<img src=x onerror=alert(1)>"\'</script>'; // a name, nothing else
const complaints = [];
const started = Date.now();
mkdirSync(scratch, { recursive: true });

const step = (text) => console.log(`${((Date.now() - started) / 1000).toFixed(1)} s: ${text}`);
const keep = async (visitor, name) => writeFileSync(join(scratch, `${name}.png`), await visitor.page.screenshot());

async function searchAndChoose(visitor) {
  step('a table is searched for, chosen, and touched on the plan');
  await visitor.asks('table');
  await visitor.presses('#panel', 'table');
  await visitor.seesText('#panel h2', 'table');
  const number = await visitor.text('#panel dd');
  await visitor.touchesTheMiddle();
  assert.equal(await visitor.text('#panel dd'), number, 'what the search shows is what a touch finds there');
  await keep(visitor, 'chosen');
}

async function renameARoom(visitor, other) {
  step('a room gets a name that would be a script, and the other page shows it');
  await visitor.presses('#list', 'room 1');
  await visitor.fills('Name of the room', HOSTILE);
  await visitor.presses('#panel', 'Rename');
  for (const each of [visitor, other]) await each.seesText('#list', HOSTILE);
  assert.equal(await other.page.$('#list img, #panel img[src="x"]'), null, 'a name is text');
}

async function nameATable(visitor, other) {
  step('a table is named by touch, found by its name, renamed, and the name is deleted and given back');
  await visitor.asks('table');
  await visitor.presses('#panel', 'table');
  await visitor.touchesTheMiddle();
  await visitor.fills('Name', `desk ${HOSTILE}`);
  await visitor.presses('#panel', 'Name it');
  await visitor.seesText('#panel .done', 'it is called');
  await other.seesText('#list', `desk ${HOSTILE}`);
  await keep(visitor, 'named');
  await visitor.fills('New name', 'desk');
  await visitor.presses('#panel', 'Rename');
  await visitor.seesText('#panel h2', 'table "desk"');
  await visitor.presses('#panel', 'Delete the name "desk"');
  await visitor.seesText('#panel .done', 'is deleted');
  assert.equal(await visitor.text('#panel h2'), 'table');
  await visitor.presses('#panel', 'Undo');
  await visitor.seesText('#panel h2', 'table "desk"');
  await other.asks('path room 3 to desk');
  await other.seesText('#panel pre', 'to table');
  step('a name that was given earlier is offered for another thing');
  await visitor.asks('seat');
  await visitor.presses('#panel', 'seat');
  await visitor.presses('#panel', 'desk');
  await visitor.seesText('#panel .done', 'it is called');
  await visitor.presses('#panel', 'Undo');
  await visitor.seesText('#panel .done', 'is undone');
}

async function deleteASeat(visitor, other) {
  step('a seat is deleted by touch, and brought back by undo and from the list of what was deleted');
  const seats = async () => (await other.text('#list')).match(/^seat/gm)?.length ?? 0;
  const before = await seats();
  const remove = async () => {
    await visitor.asks('find seat');
    await visitor.presses('#panel', 'seat');
    await visitor.presses('#panel', 'Delete it from the map');
    await visitor.presses('#panel', 'Yes');
    await visitor.seesText('#panel .done', 'is deleted');
  };
  await remove();
  await other.sees((root, most) => (root.querySelector('#list').innerText.match(/^seat/gm)?.length ?? 0) < most, before);
  await visitor.presses('#panel', 'Undo');
  await visitor.seesText('#panel .done', 'is in the map again');
  await remove();
  await visitor.page.$eval('aside > details', (each) => { each.open = true; });
  await keep(visitor, 'about');
  await visitor.presses('#about', 'Bring it back');
  await visitor.seesText('#panel .done', 'is in the map again');
  await visitor.seesText('#about', 'Is the map right?');
  await visitor.page.$eval('aside > details', (each) => { each.open = false; });
  assert.equal(await seats(), before);
}

async function nameASpot(visitor) {
  step('a spot of the floor is named');
  await visitor.presses('#list', 'room 3');
  await visitor.seesText('#panel h2', 'room 3');
  await visitor.touchesTheMiddle();
  await visitor.page.$eval('#panel details', (each) => { each.open = true; });
  await visitor.fills('Name', 'charger');
  await visitor.presses('#panel', 'Name it');
  await visitor.seesText('#list', '"charger"');
}

async function goAndStop(visitor) {
  step('the path to the charger is drawn before the robot is told to go; then it is told to stop');
  await visitor.presses('#list', '"charger"');
  await visitor.seesText('#panel h2', '"charger"');
  await visitor.presses('#panel', 'Go there');
  await visitor.seesText('#panel h2', 'Go to "charger"?');
  await keep(visitor, 'goal');
  await visitor.presses('#panel', 'Go');
  await visitor.seesText('#panel .done', 'the run was told to go');
  await visitor.presses('header', 'Stop');
  await visitor.seesText('#panel .done', 'the run was told to stop');
  const rows = readFileSync(commands, 'utf8').trimEnd().split('\n').slice(1).map((row) => row.split(',')[1]);
  assert.deepEqual(rows, ['go_to', 'stop']);
}

async function showAPath(visitor) {
  step('a path is drawn');
  await visitor.asks('path room 2 to room 3');
  await visitor.seesText('#panel pre', 'room 3');
  await keep(visitor, 'path');
}

async function showInThreeDimensions(visitor) {
  step('the map is shown in 3D, turned, and the plan comes back');
  await visitor.presses('#zoom', '3D');
  await visitor.sees((root) => root.querySelector('#solid').dataset.revision);
  const colours = await visitor.page.evaluate(() => new Promise((resolve) => {
    const solid = document.querySelector('#solid'), copy = document.createElement('canvas');
    solid.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }));
    requestAnimationFrame(() => { // just after it was drawn
      [copy.width, copy.height] = [64, 64];
      const context = copy.getContext('2d');
      context.drawImage(solid, 0, 0, 64, 64);
      resolve(new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size);
    });
  }));
  assert.ok(colours > 20, `points and surfaces have ${colours} colours`);
  const written = Number(await visitor.page.$eval('#names', (each) => each.dataset.written));
  assert.ok(written > 0, 'names are written in 3D');
  await keep(visitor, 'solid');
  await visitor.presses('#zoom', 'Plan');
  await visitor.sees((root) => root.querySelector('#solid').hidden);
}

async function changeInThreeDimensions(visitor) {
  step('in 3D a change fetches no files again; files that do not come fail no change');
  const { page } = visitor, files = [];
  const refuse = (request) => {
    const isFile = /api\/(points|surfaces)/.test(request.url());
    if (isFile) files.push(request.url());
    return isFile ? request.abort() : request.continue();
  };
  const rename = async (from, to) => {
    await visitor.presses('#list', from);
    await visitor.fills('Name of the room', to);
    await visitor.presses('#panel', 'Rename');
    await visitor.seesText('#list', to);
    await visitor.seesText('#panel .done', to);
  };
  await page.setRequestInterception(true);
  page.on('request', refuse);
  await visitor.presses('#zoom', '3D');
  await rename('room 2', 'study');
  assert.deepEqual(files, []);
  utimesSync(join(map, 'points.ply'), new Date(), new Date());
  await visitor.seesText('#state', 'does not answer');
  await rename('study', 'library');
  assert.equal(await page.$('#panel .bad'), null);
  page.off('request', refuse);
  await page.setRequestInterception(false);
  await visitor.presses('#zoom', 'Plan');
}

async function darkColours(visitor) {
  step('the page is dark where the browser is');
  const before = await visitor.page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await visitor.page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'dark' }]);
  await visitor.sees((root, light) => getComputedStyle(root.querySelector('body')).backgroundColor !== light, before);
  await keep(visitor, 'dark');
}

async function phone(visitor) {
  step('nothing is wider than a phone');
  const width = await visitor.page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= 360, `the page is ${width} px wide on a phone of 360 px`);
  await keep(visitor, 'phone');
}

async function surviveTheServer(visitors, server) {
  step('the server is killed; the pages say so, and come back with it');
  const revisions = await visitors[0].text('#list');
  await server.kill('SIGKILL');
  for (const visitor of visitors) await visitor.seesText('#state', 'not reached');
  const next = await startServer(program, map, server.port);
  for (const visitor of visitors) await visitor.seesText('#state', 'landmarks');
  for (const visitor of visitors) await visitor.sees((root) => !root.querySelector('#lost').hidden);
  assert.equal(await visitors[0].text('#list'), revisions, 'what was confirmed is still there');
  return next;
}

async function openACopy(browser) {
  step('a copy of the map opens from a folder, without a server, and may only look');
  const folder = join(scratch, 'copy');
  execFileSync(join(programs, 'omnimapper-export'), ['page', map, folder]);
  const guest = await Visitor.arrive(browser, `file://${folder}/index.html`, complaints);
  assert.ok(await guest.page.$eval('#dimension', (each) => each.hidden), 'a copy has no view in 3D');
  await guest.asks('desk');
  await guest.presses('#panel', 'table "desk"');
  await guest.seesText('#panel', 'may only look');
  await guest.touchesTheMiddle();
  await guest.seesText('#panel h2', 'table "desk"');
  await keep(guest, 'copy');
}

const { browser, stop } = await startBrowser(puppeteer, join(scratch, 'profile'));
let server = null;
try {
  server = await startServer(program, map, 0, ['--commands', commands]);
  const desk = await Visitor.arrive(browser, server.address, complaints);
  step('the first picture is there');
  const tablet = await Visitor.arrive(browser, server.address, complaints, { width: 360, height: 740, isTouch: true });
  await searchAndChoose(desk);
  await renameARoom(tablet, desk);
  await nameATable(tablet, desk);
  await deleteASeat(tablet, desk);
  await nameASpot(desk);
  await goAndStop(desk);
  await showAPath(desk);
  await phone(tablet);
  await showInThreeDimensions(desk);
  await changeInThreeDimensions(desk);
  await darkColours(desk);
  server = await surviveTheServer([desk, tablet], server);
  await openACopy(browser);
  assert.deepEqual(complaints, []);
  step('done');
} finally {
  await stop();
  await server?.kill('SIGTERM');
}
