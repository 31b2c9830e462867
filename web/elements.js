// Elements of the page, whose text is never read as HTML.

export function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

export function button(text, onClick) {
  const made = element('button', text);
  made.type = 'button';
  made.addEventListener('click', onClick);
  return made;
}

/** A field with a button beside it; `onText` gets what was typed. */
export function field(label, value, action, onText) {
  const form = element('form'), input = element('input');
  input.value = value;
  input.maxLength = 200;
  input.setAttribute('aria-label', label);
  form.append(input, element('button', action));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const text = input.value.trim();
    if (text) onText(text);
    else input.focus();
  });
  return form;
}
