// Sending the robot somewhere: goal and path are drawn before they are confirmed.
import { button, element } from './elements.js';
import { source } from './source.js';

/**
 * A button that asks how the robot would go to something. `actions`: show(parts), showPath(points or null),
 * carryOut(words, act) as a panel has them.
 */
export function goThere(called, shown, actions) {
  return button('Go there', async () => {
    actions.show(element('p', `How would the robot go to ${shown}?`, 'note'));
    try {
      const [{ is_found: isFound, text, answer }, ticket] = await Promise.all(
        [source.question(`path here to ${called}`), source.ticket()]);
      if (!isFound) return actions.show(element('p', text, 'bad'));
      actions.show(...proposal(called, shown, text, ticket, actions));
      actions.showPath(answer.points_m);
    } catch (error) {
      actions.show(element('p', error.message, 'bad'));
    }
  });
}

function proposal(called, shown, text, ticket, actions) {
  const buttons = element('div', undefined, 'row');
  const end = (...parts) => {
    actions.showPath(null);
    actions.show(...parts);
  };
  buttons.append(
    button('Go', () => {
      end();
      actions.carryOut(['go to', shown], () => source.goTo(called, ticket));
    }),
    button('Cancel', () => end(element('p', 'The robot was not told to go.', 'note'))));
  return [element('h2', `Go to ${shown}?`), element('pre', text), buttons,
    element('p', 'The path is drawn on the map. It is asked for again after a minute.', 'note')];
}
