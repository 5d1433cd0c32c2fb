#pragma once

namespace semblante {

/// Opens /dev/null in place of each of standard input, output and error that is closed. Without that the next file or
/// socket gets its number, and what is printed or logged is written into it. To be called before anything is opened.
void open_standard_streams();

/// Whether all that was printed has been written. False for a full disk behind a redirection.
bool is_output_written();

}  // namespace semblante
