import type { NewStream } from '../../net/types.ts';
import { openDialog } from '../shared/dialog.ts';
import { h } from '../shared/dom.ts';

/** ms; the server's default and maximum. */
const usualBatch = 100;
const mostBatch = 1000;

/** Asks for title and options of a new stream; null: cancelled. */
export async function askForStream(): Promise<{ title: string; options: NewStream } | null> {
  const title = h('input', { type: 'text', id: 'stream-title', maxlength: 120, required: true, autocomplete: 'off' });
  title.value = 'My stream';
  const batch = h('input', {
    type: 'number',
    id: 'stream-batch',
    min: 0,
    max: mostBatch,
    step: 1,
    required: true,
    value: usualBatch,
    'aria-describedby': 'stream-batch-note',
  });
  const share = h('input', {
    type: 'number',
    id: 'stream-share',
    min: 0,
    max: 100,
    step: 1,
    placeholder: 'as the head has it',
    'aria-describedby': 'stream-share-note',
  });
  const accepted = await openDialog(
    { title: 'New stream', accept: 'Create' },
    h('label', { for: 'stream-title' }, 'Title'),
    title,
    h('label', { for: 'stream-batch' }, 'Gather frames for, ms'),
    batch,
    h('p', { class: 'small', id: 'stream-batch-note' }, '0 sends each at once; longer is fewer bytes, and later.'),
    h('label', { for: 'stream-share' }, 'Share of visemes, %'),
    share,
    h('p', { class: 'small', id: 'stream-share-note' }, 'Where a viseme and an expression move the same point.'),
  );
  if (!accepted) return null;
  const options: NewStream = { batch_interval: batch.valueAsNumber };
  if (!Number.isNaN(share.valueAsNumber)) options.viseme_share = share.valueAsNumber / 100;
  return { title: title.value.trim(), options };
}
