import type { FapFileOddity, FapFileWarning } from '@protocol/fap_file.ts';

const sentences: Record<FapFileOddity, string> = {
  other_version: 'another version than 2.0 to 2.2, read as those are',
  blank_in_name: 'blanks in the name of the header',
  count_differs: 'the header announces another number of frames than there are',
  extra_flag: '69 flags instead of 68: the last is dropped',
  few_values: 'fewer values than flags: the last FAPs are left out',
  more_values: 'more values than flags: the last are dropped',
  not_finite: 'infinite or no number: zero instead',
  first_number_not_zero: 'frames are not counted from 0',
  numbers_not_rising: 'frame numbers do not rise: sorted, and the later of two alike stays',
  numbers_left_out: 'frame numbers are left out: the face holds still there',
  single_number_viseme: 'FAP 1 as one number: that viseme in full',
  packed_viseme: 'FAP 1 packed in one number: unpacked',
  single_number_expression: 'FAP 2 as one number: that expression in full',
  unknown_select: 'FAP 1 or 2 names no viseme or expression: left out',
  strength_out_of_range: 'a strength beyond 0 to 63: held within',
  strength_not_whole: 'a strength that is not whole: rounded',
};

/** "Line 3: 69 flags instead of 68: the last is dropped (108 times)" */
export function fapWarningText({ oddity, line, count }: FapFileWarning): string {
  return `Line ${line}: ${sentences[oddity]}${count > 1 ? ` (${count} times)` : ''}`;
}
