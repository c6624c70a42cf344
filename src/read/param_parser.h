// Reads a parameter list from tokens: types, counts and finiteness are checked here, once.
#pragma once

#include "params.h"
#include "tokenizer.h"

namespace nephroid {

ParamList parse_params(Tokenizer& tokens, Context& context, FileColorSpace color_space);

/// The next token as a finite number or a quoted string; fails otherwise. `what` names the directive.
double required_number(Tokenizer& tokens, Context& context, std::string_view what);
std::string required_string(Tokenizer& tokens, Context& context, std::string_view what);

}  // namespace nephroid
