// Participating media. What they absorb is rendered inside dielectrics; what they scatter and emit is not yet.
#pragma once

#include "params.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nephroid {

class Media {
  public:
    explicit Media(Context& context) : context_(context) {}

    /// MakeNamedMedium.
    void define(std::string const& name, Params& p);
    /// MediumInterface names it.
    void use(std::string const& name, SourceLocation where);
    /// MediumInterface names it as what is outside.
    void surround(std::string const& name, SourceLocation where);
    /// The object that is about to be added to `group` has `medium` inside.
    void fill(GroupId group, std::string const& medium);

    /// Once materials are made: gives dielectrics their media's absorption, and says what is ignored.
    void finish();

  private:
    struct Medium {
        std::optional<Spd> absorption;  // 1 / length; none: of a kind that is not rendered at all
        SourceLocation where;
    };
    struct Filled {
        GroupId group;
        std::size_t object;
        std::string medium;
    };

    Context& context_;
    std::map<std::string, Medium, std::less<>> media_;
    std::map<std::string, SourceLocation, std::less<>> used_;  // and where first
    std::map<std::string, SourceLocation, std::less<>> outside_;
    std::vector<Filled> filled_;
};

}  // namespace nephroid
