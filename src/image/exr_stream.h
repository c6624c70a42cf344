// OpenEXR on memory: streams, and one place where its exceptions become ours. Not part of the room's interface.
#pragma once

#include "codecs.h"

#include <OpenEXR/ImfIO.h>

#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

namespace nephroid::codec {

class ExrSource : public Imf::IStream {
  public:
    ExrSource(Bytes file, std::string const& path) : IStream(path.c_str()), file_(file) {}
    bool read(char out[], int n) override {
        if (n < 0 || static_cast<std::size_t>(n) > file_.size() - at_)
            throw std::runtime_error("the file is truncated");
        std::memcpy(out, file_.data() + at_, static_cast<std::size_t>(n));
        at_ += static_cast<std::size_t>(n);
        return at_ < file_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        if (position > file_.size()) throw std::runtime_error("an offset points past the end of the file");
        at_ = position;
    }
    void clear() override {}

  private:
    Bytes file_;
    std::size_t at_ = 0;
};

class ExrSink : public Imf::OStream {
  public:
    explicit ExrSink(std::string const& path) : OStream(path.c_str()) {}
    void write(char const in[], int n) override {
        auto const count = static_cast<std::size_t>(n);
        if (at_ + count > data.size()) data.resize(at_ + count);
        std::memcpy(data.data() + at_, in, count);
        at_ += count;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    std::vector<std::byte> data;

  private:
    std::size_t at_ = 0;
};

/// Calls f(); what OpenEXR throws becomes an Error of this file.
template <class F>
auto translating_exr_errors(std::string const& path, F&& f) {
    try {
        return f();
    } catch (Error const&) {
        throw;
    } catch (std::bad_alloc const&) {
        fail(path, "the image does not fit in memory; scale it down", ErrorKind::Limit);
    } catch (std::exception const& e) {
        fail(path, std::string("the EXR file cannot be used: ") + e.what());
    }
}

/// Looks through all headers before OpenEXR does, because OpenEXR allocates what they ask for: sizes, windows, channels,
/// tables of offsets that must fit in the file. Refuses deep files.
void check_exr_headers(Bytes file, std::string const& path);

}  // namespace nephroid::codec
