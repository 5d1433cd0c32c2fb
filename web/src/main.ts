const root = document.querySelector<HTMLElement>('#studio');
if (root) root.textContent = 'Semblante';
