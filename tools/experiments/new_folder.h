// A folder that is made anew: what was there before stays until all of the new one is.
#pragma once

#include <filesystem>

namespace nephroid::experiment {

class NewFolder {
  public:
    /// Makes `path`.new, empty: what an aborted run left there is removed. Throws std::filesystem::filesystem_error.
    explicit NewFolder(std::filesystem::path path);
    /// Removes it, unless it was kept.
    ~NewFolder();
    NewFolder(NewFolder const&) = delete;
    NewFolder& operator=(NewFolder const&) = delete;

    /// Where to write until then.
    [[nodiscard]] std::filesystem::path const& path() const { return new_; }
    /// Takes the place of what is at `path`.
    void keep();

  private:
    std::filesystem::path final_, new_;
    bool kept_ = false;
};

}  // namespace nephroid::experiment
