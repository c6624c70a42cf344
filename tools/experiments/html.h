// Markdown, as far as Page writes it, as an HTML page that needs nothing else.
#pragma once

#include <string>

namespace nephroid::experiment {

/// Headings, paragraphs, lists, tables, fenced code, pictures; within them `code`, **bold**, *italics* and [links](…). A comment that
/// is a paragraph of its own becomes one that is seen. The first heading is the title.
std::string html_of(std::string const& markdown);

}  // namespace nephroid::experiment
