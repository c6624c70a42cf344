// Progress on stderr: a bar that redraws itself on a terminal, a line now and then elsewhere, JSON lines on request.
#pragma once

#include "render/render.h"

#include <string>

namespace nephroid::cli {

enum class ProgressStyle { Quiet, Bar, Lines, Json };

class ProgressPrinter {
  public:
    explicit ProgressPrinter(ProgressStyle style) : style_(style) {}
    ~ProgressPrinter() { finish(); }
    void operator()(RenderProgress const& p);
    /// Ends the bar's line.
    void finish();

  private:
    ProgressStyle style_;
    double last_printed_ = -1e9;
    bool open_line_ = false;
};

/// Bar on a terminal, lines otherwise; `log` "json" or `quiet` override.
ProgressStyle progress_style(bool quiet, std::string const& log);

}  // namespace nephroid::cli
