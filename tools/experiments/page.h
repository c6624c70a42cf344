// A page of Markdown with its pictures beside it. Numbers that are not finite are refused: a page says nothing that was
// not measured.
#pragma once

#include "new_folder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::experiment {

/// `digits` significant digits, without an exponent between 0.001 and 100,000. Throws std::runtime_error for nan and inf.
std::string number(double value, int digits = 3);
/// A fixed count of decimals, with a proper minus.
std::string fixed(double value, int decimals);
/// A share as "1.23%", with two significant digits.
std::string percent(double share);
/// "0.123 ± 0.004": the error has one digit, or two when it begins with 1, and the value as many decimals.
std::string with_error(double value, double error);

class Page {
  public:
    /// folder/name.md and folder/name/…, both as they were until write().
    Page(std::filesystem::path folder, std::string name, std::string const& title);

    void section(std::string const& title);
    void subsection(std::string const& title);
    void text(std::string const& paragraph);
    void list(std::vector<std::string> const& items);
    /// pbrt text, as it was run.
    void code(std::string const& text);
    void table(std::vector<std::string> const& head, std::vector<std::vector<std::string>> const& rows);
    /// A paragraph that only the HTML page has, as Markdown.
    void for_browsers(std::string const& paragraph);
    /// A picture that is, or will be, at file(name): a place that holds until write().
    void image(std::string const& name, std::string const& alt);
    [[nodiscard]] std::filesystem::path file(std::string const& name) const;
    void save(std::string const& name, std::string const& text) const;

    /// Once, at the end: the pictures take the place of those that were there, and the page that of the page, as Markdown, and as
    /// HTML beside it if asked for. Throws Error(Io), std::filesystem::filesystem_error.
    void write(bool html = false);

  private:
    std::filesystem::path folder_;
    std::string name_;
    NewFolder pictures_;
    std::string text_;
};

}  // namespace nephroid::experiment
