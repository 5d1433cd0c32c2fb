// A file of its own, because a Content-Security-Policy may forbid scripts within a page.
const face = document.querySelector('semblante-face');
const status = document.querySelector('[role=status]');
// The element's server: an address, a path on the server of this page, or that server itself.
const server = new URL(face.getAttribute('src') || '/', location.href).href.replace(/\/+$/, '');
const speech = `${server}/v1/streams/demo/speech`;
for (const button of document.querySelectorAll('button'))
  button.onclick = async () => {
    status.textContent = '';
    try {
      await face.setSound(true); // browsers let a page be heard after a tap
      const body = JSON.stringify({ text: button.dataset.text, language: button.lang, take_over: true });
      const answer = await fetch(speech, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body });
      if (!answer.ok) status.textContent = (await answer.json()).detail;
    } catch (error) {
      status.textContent = String(error.message ?? error);
    }
  };
