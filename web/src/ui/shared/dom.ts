export type Child = Node | string | number | null | undefined | false | readonly Child[];

type Handlers = { [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void };
export interface Props {
  class?: string;
  on?: Handlers;
  [attribute: string]: string | number | boolean | null | undefined | Handlers;
}

/** An element with attributes, listeners and children. `true` sets an empty attribute; `false` and null set none. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (name === 'on') {
      for (const [event, handler] of Object.entries(value as Handlers))
        element.addEventListener(event, handler as EventListener);
    } else if (value !== false && value !== null && value !== undefined) {
      element.setAttribute(name, value === true ? '' : String(value));
    }
  }
  append(element, children);
  return element;
}

export function append(parent: Node, children: readonly Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    if (Array.isArray(child)) append(parent, child as readonly Child[]);
    else parent.appendChild(child instanceof Node ? child : document.createTextNode(String(child)));
  }
}

export function replace(parent: Element, ...children: Child[]): void {
  parent.replaceChildren();
  append(parent, children);
}

/** Gives an element these children; those that it has already stay in their places, with their focus. */
export function keepChildren(parent: Element, children: readonly Element[]): void {
  const wanted = new Set(children);
  for (const child of [...parent.children]) if (!wanted.has(child)) child.remove();
  children.forEach((child, i) => {
    if (parent.children[i] !== child) parent.insertBefore(child, parent.children[i] ?? null);
  });
}

/**
 * Gives a choice these values with their texts, and chooses `value`. The same ones as before stay: a new option closes the list that
 * somebody has open, and there may be hundreds.
 */
export function setOptions(select: HTMLSelectElement, options: readonly (readonly [value: string, text: string])[], value: string): void {
  const same = options.length === select.options.length &&
    options.every(([wanted, text], i) => select.options[i]!.value === wanted && select.options[i]!.textContent === text);
  if (!same) replace(select, options.map(([wanted, text]) => h('option', { value: wanted }, text)));
  select.value = value;
}

/** Redraws a container and restores the focus to the control with the same `data-focus`. */
export function redraw(container: Element, draw: () => void): void {
  const active = container.contains(document.activeElement) ? document.activeElement : null;
  const key = active?.getAttribute('data-focus') ?? null;
  draw();
  if (key !== null)
    container.querySelector<HTMLElement>(`[data-focus="${CSS.escape(key)}"]`)?.focus({ preventScroll: true });
}

/** Sets an element's text if it differs; cheap enough for the frame loop. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

const svgNamespace = 'http://www.w3.org/2000/svg';
export function svg(
  tag: string,
  attributes: Record<string, string | number> = {},
  ...children: (Element | string)[]
): SVGElement {
  const element = document.createElementNS(svgNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}
