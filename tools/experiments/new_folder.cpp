#include "new_folder.h"

#include <system_error>
#include <utility>

namespace nephroid::experiment {

NewFolder::NewFolder(std::filesystem::path path) : final_(std::move(path)), new_(final_) {
    new_ += ".new";
    std::filesystem::remove_all(new_);
    std::filesystem::create_directories(new_);
}

NewFolder::~NewFolder() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(new_, ignored);
}

void NewFolder::keep() {
    std::filesystem::remove_all(final_);
    std::filesystem::rename(new_, final_);
    kept_ = true;
}

}  // namespace nephroid::experiment
