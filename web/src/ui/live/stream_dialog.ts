import type { NewStream } from '../../net/types.ts';
import { openDialog } from '../shared/dialog.ts';
import { h } from '../shared/dom.ts';
import { nameInput } from '../shared/name_input.ts';
import { t } from '../../words/words.ts';

/** The server's default and maximum batch interval, ms. */
const usualBatch = 100;
const mostBatch = 1000;

/** Asks the user for title and options of a new stream; null when cancelled. */
export async function askForStream(): Promise<{ title: string; options: NewStream } | null> {
  const title = nameInput('stream-title', t('My stream'));
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
    placeholder: t('default of the head'),
    'aria-describedby': 'stream-share-note',
  });
  const accepted = await openDialog(
    { title: t('New stream'), accept: t('Create') },
    h('label', { for: 'stream-title' }, t('Title')),
    title,
    h('label', { for: 'stream-batch' }, t('Batch interval, ms')),
    batch,
    h('p', { class: 'small', id: 'stream-batch-note' }, t('0 sends each frame at once; a longer interval saves bytes but adds delay.')),
    h('label', { for: 'stream-share' }, t('Viseme share, %')),
    share,
    h('p', { class: 'small', id: 'stream-share-note' }, t('Its weight where an expression moves the same point.')),
  );
  if (!accepted) return null;
  const options: NewStream = { batch_interval: batch.valueAsNumber };
  if (!Number.isNaN(share.valueAsNumber)) options.viseme_share = share.valueAsNumber / 100;
  return { title: title.value.trim(), options };
}
