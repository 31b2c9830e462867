// Somebody who looks at the page of a map in a browser of their own.
import assert from 'node:assert/strict';

const PATIENCE_MS = 30000; // other programs may have the cores

export class Visitor {
  /** Opens a page with cookies of its own; `complaints` collects what the page should not say. */
  static async arrive(browser, address, complaints, { width = 1280, height = 800, isTouch = false } = {}) {
    const context = await browser.createBrowserContext();
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    page.on('pageerror', (error) => complaints.push(error.message));
    page.on('dialog', (dialog) => {
      complaints.push(`a dialog: ${dialog.message()}`);
      dialog.dismiss();
    });
    await page.setViewport({ width, height, isMobile: isTouch, hasTouch: isTouch });
    await page.goto(address);
    const visitor = new Visitor(page);
    await visitor.sees((root) => root.dataset.revision);
    return visitor;
  }

  constructor(page) {
    this.page = page;
  }

  /** Waits until `condition`, a function of the page's root element and of `value`, holds. */
  async sees(condition, value) {
    const text = condition.toString();
    await this.page.waitForFunction(`(${text})(document.documentElement, ${JSON.stringify(value ?? null)})`)
      .catch(async (error) => {
        throw new Error(`${error.message}: ${text} of ${value}; the panel says: ${await this.text('#panel')}; `
          + `the state: ${await this.text('#state')}`);
      });
  }

  /** Waits until an element shows a text. */
  seesText(selector, text) {
    return this.sees((root, [where, what]) => root.querySelector(where)?.innerText.includes(what), [selector, text]);
  }

  text(selector) {
    return this.page.$eval(selector, (each) => each.innerText);
  }

  async asks(question) {
    await this.page.$eval('#question', (input, text) => { input.value = text; }, question);
    await this.page.focus('#question');
    await this.page.keyboard.press('Enter');
    await this.seesText('#panel h2', question);
  }

  /** Presses the first button within an element whose text begins so, by touch if the screen has it. */
  async presses(selector, text) {
    for (let tries = 3; ; --tries) {
      const found = await this.page.evaluateHandle((where, what) => [...document.querySelectorAll(`${where} button`)]
        .find((each) => each.innerText.trim().startsWith(what)), selector, text);
      const button = found.asElement();
      assert.ok(button, `${selector} has no button "${text}": ${await this.text(selector)}`);
      try {
        await button.evaluate((each) => each.scrollIntoView({ block: 'center' }));
        return await (this.page.viewport().hasTouch ? button.tap() : button.click());
      } catch (error) {
        // A change of another page draws the list anew.
        if (tries === 0 || !/detached|not clickable/.test(error.message)) throw error;
      }
    }
  }

  /** Types into the field with that label, in place of what is there. */
  async fills(label, text) {
    const field = await this.page.waitForSelector(`[aria-label="${label}"]`);
    await field.evaluate((input) => { input.value = ''; });
    await field.type(text);
  }

  /** Touches the middle of the plan. */
  async touchesTheMiddle() {
    const { x, y, width, height } = await (await this.page.$('#plan')).boundingBox();
    if (this.page.viewport().hasTouch) await this.page.touchscreen.tap(x + width / 2, y + height / 2);
    else await this.page.mouse.click(x + width / 2, y + height / 2);
  }
}
