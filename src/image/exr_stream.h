// OpenEXR on memory: streams, and one place where its exceptions become ours. Not part of the room's interface.
#pragma once

#include "codecs.h"
#include "image/file.h"

#include <OpenEXR/ImfIO.h>

#include <cstring>
#include <exception>
#include <filesystem>
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

/// A file that is read piece by piece: films may be larger than what one would keep in memory twice.
class ExrFileSource : public Imf::IStream {
  public:
    /// Throws Error(Io) like read_file().
    explicit ExrFileSource(std::filesystem::path const& path);
    ~ExrFileSource() override;
    bool read(char out[], int n) override;
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }
    void clear() override {}
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// The first bytes, for a look at the header.
    [[nodiscard]] std::vector<std::byte> head(std::size_t most);

  private:
    int fd_ = -1;
    std::uint64_t at_ = 0, size_ = 0;
};

/// Gathers small writes. What fails is kept by the file and said by its commit().
class ExrSink : public Imf::OStream {
  public:
    ExrSink(std::string const& path, NewFile& file) : OStream(path.c_str()), file_(&file) {}
    void write(char const in[], int n) override {
        auto const bytes = std::as_bytes(std::span(in, static_cast<std::size_t>(n)));
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
        at_ += bytes.size();
        if (buffer_.size() >= (std::size_t{1} << 20)) flush();
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override {
        flush();
        file_->seek(at_ = position);
    }
    void flush() {
        bool const good = file_->write(buffer_);
        buffer_.clear();
        if (!good) throw std::runtime_error("the file cannot be written");
    }

  private:
    NewFile* file_;
    std::vector<std::byte> buffer_;
    std::uint64_t at_ = 0;
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
/// tables of offsets that must fit in the file. Refuses deep files. `head` are the first bytes of a file of `size`.
void check_exr_headers(Bytes head, std::uint64_t size, std::int64_t most_bytes, std::string const& path);

}  // namespace nephroid::codec
