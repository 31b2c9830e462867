// Where the map comes from: a server, or a copy beside the page.
import * as exported from './exported.js';
import * as server from './server.js';

export const source = globalThis.omnimapperMap ? exported : server;
