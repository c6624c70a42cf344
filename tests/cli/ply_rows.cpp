// ply_rows FILE ELEMENT: the rows of one element of a binary PLY file as text, one a line, under a line of the properties' names. It
// shares nothing with the reader or the writer that are tested. Exit code 1 for what is not such a file, or of another size.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Element {
    std::string name;
    long count = 0;
    std::vector<std::string> properties, types;
};

std::size_t size_of(std::string const& type) { return type == "uchar" ? 1 : 4; }

void print(char const* at, std::string const& type) {
    if (type == "float") {
        float v = 0;
        std::memcpy(&v, at, sizeof v);
        std::printf(" %.9g", static_cast<double>(v));
    } else if (type == "int") {
        std::int32_t v = 0;
        std::memcpy(&v, at, sizeof v);
        std::printf(" %d", v);
    } else {
        std::printf(" %d", static_cast<unsigned char>(*at));
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 1;
    std::ifstream file(argv[1], std::ios::binary);
    std::string const data{std::istreambuf_iterator<char>(file), {}};
    std::string const end = "end_header\n";
    auto const header_end = data.find(end);
    if (!data.starts_with("ply\nformat binary_little_endian 1.0\n") || header_end == std::string::npos)
        return 1;
    std::istringstream header(data.substr(0, header_end));
    std::vector<Element> elements;
    for (std::string line; std::getline(header, line);) {
        std::istringstream words(line);
        std::string word, type, name;
        words >> word;
        if (word == "element") {
            Element& e = elements.emplace_back();
            words >> e.name >> e.count;
        } else if (word == "property" && !elements.empty() && words >> type >> name) {
            if (type != "float" && type != "int" && type != "uchar") return 1;
            elements.back().types.push_back(type), elements.back().properties.push_back(name);
        }
    }
    std::size_t at = header_end + end.size();
    for (Element const& e : elements) {
        bool const wanted = e.name == argv[2];
        if (wanted) {
            for (std::string const& p : e.properties) std::printf(" %s", p.c_str());
            std::printf("\n");
        }
        for (long i = 0; i < e.count; ++i) {
            for (std::string const& type : e.types) {
                if (at + size_of(type) > data.size()) return 1;
                if (wanted) print(data.data() + at, type);
                at += size_of(type);
            }
            if (wanted) std::printf("\n");
        }
    }
    return at == data.size() ? 0 : 1;
}
