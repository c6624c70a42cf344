#include "shown.h"

namespace nephroid {

std::string shown(std::string_view text, std::size_t most) {
    bool const cut = text.size() > most;
    if (cut) {
        // Not in the middle of a UTF-8 character.
        while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0u) == 0x80u) --most;
        text = text.substr(0, most);
    }
    std::string out;
    for (char const c : text) {
        auto const byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte != 0x7f) {
            out += c;
        } else if (c == '\n' || c == '\t') {
            out += c == '\n' ? "\\n" : "\\t";
        } else {
            out += "\\x";
            out += "0123456789abcdef"[byte >> 4];
            out += "0123456789abcdef"[byte & 15u];
        }
    }
    return cut ? out + "…" : out;
}

}  // namespace nephroid
