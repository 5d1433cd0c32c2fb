import type { FapFileOddity, FapFileWarning } from '@protocol/fap_file.ts';

const sentences: Record<FapFileOddity, string> = {
  other_version: 'a version other than 2.0 to 2.2: read like those',
  blank_in_name: 'blanks in the name in the header',
  count_differs: 'the number of frames in the header is wrong',
  extra_flag: '69 flags instead of 68: the last is dropped',
  few_values: 'fewer values than flags: the last FAPs are omitted',
  more_values: 'more values than flags: the last are dropped',
  not_finite: 'infinite or not a number: replaced by zero',
  first_number_not_zero: 'the first frame number is not 0',
  numbers_not_rising: 'frame numbers do not increase: sorted; of two equal ones the later is kept',
  numbers_left_out: 'frame numbers are missing: the face holds still there',
  single_number_viseme: 'FAP 1 as one number: that viseme at full strength',
  packed_viseme: 'FAP 1 packed into one number: unpacked',
  single_number_expression: 'FAP 2 as one number: that expression at full strength',
  unknown_select: 'FAP 1 or 2 selects an unknown viseme or expression: omitted',
  strength_out_of_range: 'a strength outside 0 to 63: clamped',
  strength_not_whole: 'a strength that is not an integer: rounded',
};

/** "Line 3: 69 flags instead of 68: the last is dropped (108 times)" */
export function fapWarningText({ oddity, line, count }: FapFileWarning): string {
  return `Line ${line}: ${sentences[oddity]}${count > 1 ? ` (${count} times)` : ''}`;
}
