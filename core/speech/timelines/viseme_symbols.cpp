#include "core/speech/timelines/viseme_symbols.h"

#include <algorithm>

namespace semblante {

const VisemeSymbol* VisemeSymbols::find(std::string_view symbol) const {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const VisemeSymbol& row) { return row.symbol == symbol; });
  return at == rows.end() ? nullptr : &*at;
}

}  // namespace semblante
