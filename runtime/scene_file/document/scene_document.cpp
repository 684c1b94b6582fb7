// SPDX-License-Identifier: Apache-2.0
// JSON text -> a tree of values that know their line and column.
#include "runtime/scene_file/document/scene_document.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

/// Walks over the tokens of a JSON text that another parser has found well-formed, to find the
/// position of each.
class TokenCursor {
  public:
    explicit TokenCursor(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }

    /// Position of the next token, commas and colons not counted; the cursor then stands behind it.
    TextPosition next() {
        skip_gaps();
        const TextPosition start = at_;
        if (peek() == '"') {
            skip_string();
        } else if (is_one_of(peek(), "{}[]")) {
            advance();
        } else {
            while (i_ < text_.size() && !is_one_of(peek(), " \t\r\n,:{}[]\"/")) advance();
        }
        return start;
    }

    /// Position of a byte of the text, which lies ahead of the cursor.
    TextPosition seek(size_t byte) {
        while (i_ < byte && i_ < text_.size()) advance();
        return at_;
    }

  private:
    static bool is_one_of(char c, std::string_view set) { return set.find(c) != set.npos; }

    char peek(size_t ahead = 0) const {
        return i_ + ahead < text_.size() ? text_[i_ + ahead] : '\0';
    }

    void advance() {
        const auto c = static_cast<unsigned char>(text_[i_++]);
        if (c == '\n') {
            ++at_.line;
            at_.column = 1;
        } else if (c < 0x80 || c >= 0xC0) {  // all but the continuation bytes 10xxxxxx of UTF-8
            ++at_.column;
        }
    }

    void skip_gaps() {
        while (i_ < text_.size()) {
            if (peek() == '/' && peek(1) == '/') {
                while (i_ < text_.size() && peek() != '\n') advance();
            } else if (peek() == '/' && peek(1) == '*') {
                const size_t end = text_.find("*/", i_ + 2);
                seek(end == text_.npos ? text_.size() : end + 2);
            } else if (is_one_of(peek(), " \t\r\n,:")) {
                advance();
            } else {
                return;
            }
        }
    }

    void skip_string() {
        advance();
        while (i_ < text_.size() && peek() != '"') {
            if (peek() == '\\') advance();
            if (i_ < text_.size()) advance();
        }
        if (i_ < text_.size()) advance();
    }

    std::string_view text_;
    size_t i_ = 0;
    TextPosition at_;
};

/// Receives the events of nlohmann's parser, which has no recursion to exhaust, and builds the
/// tree.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    TreeBuilder(std::string_view text, const std::string& file)
        : text_(text), file_(file), cursor_(text) {}

    JsonValue take_root() { return std::move(root_); }

    bool null() override { return add(JsonType::null), true; }
    bool boolean(bool value) override { return add(JsonType::boolean).boolean = value, true; }
    bool number_integer(number_integer_t value) override {
        return add_number(static_cast<double>(value));
    }
    bool number_unsigned(number_unsigned_t value) override {
        return add_number(static_cast<double>(value));
    }
    bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
    bool string(string_t& value) override {
        return add(JsonType::string).text = std::move(value), true;
    }
    bool binary(binary_t&) override { return false; }
    bool start_object(size_t) override { return open(JsonType::object); }
    bool start_array(size_t) override { return open(JsonType::array); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const TextPosition at = cursor_.next();
        if (!open_.back().keys.insert(name).second) {
            fail(at, "the key \"" + name.substr(0, 60) + "\" stands twice in this object");
        }
        open_.back().value->members.push_back({std::move(name), at, {}});
        return true;
    }

    bool parse_error(size_t bytes_read, const std::string&,
                     const nlohmann::json::exception& error) override {
        std::string reason = error.what();
        reason.erase(0, reason.find("] ") + 2);  // "[json.exception.parse_error.101] "
        if (reason.starts_with("parse error at ")) reason.erase(0, reason.find(": ") + 2);
        if (reason.size() > 200) reason = reason.substr(0, 200) + "...";
        const TextPosition at = TokenCursor(text_).seek(bytes_read == 0 ? 0 : bytes_read - 1);
        if (text_.find('{') == text_.npos)
            reason +=
                "; a scene begins with {, and other files that are read are known by their "
                "endings: see scenes/manual/model_files.md";
        fail(at, "this is not JSON: " + reason);
    }

  private:
    struct Open {
        JsonValue* value;  // doesn't move while it is open: nothing is added to its parent
        std::unordered_set<std::string> keys;
    };

    [[noreturn]] void fail(TextPosition at, const std::string& sentence) const {
        throw Error(ErrorKind::scene, "{}: {}", SourcePlace{file_, at.line, at.column, {}},
                    sentence);
    }

    JsonValue& add(JsonType type) {
        const TextPosition at = cursor_.next();
        if (++count_ > kMaxJsonValues) {
            fail(at, fmt::format("a scene holds at most {} values", kMaxJsonValues));
        }
        JsonValue* value = &root_;
        if (!open_.empty()) {
            JsonValue& parent = *open_.back().value;
            value = parent.type == JsonType::object ? &parent.members.back().value
                                                    : &parent.items.emplace_back();
        }
        value->type = type;
        value->at = at;
        return *value;
    }

    bool add_number(double number) { return add(JsonType::number).number = number, true; }

    bool open(JsonType type) {
        JsonValue& value = add(type);
        if (open_.size() >= kMaxJsonDepth) {
            fail(value.at,
                 fmt::format("values are nested more than {} levels deep", kMaxJsonDepth));
        }
        open_.push_back({&value, {}});
        return true;
    }

    bool close() {
        cursor_.next();
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    std::string file_;
    TokenCursor cursor_;
    JsonValue root_;
    std::vector<Open> open_;
    int count_ = 0;
};

}  // namespace

JsonValue parse_json(std::string_view text, const std::string& file) {
    TreeBuilder builder(text, file);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder,
                              nlohmann::json::input_format_t::json, true, true);
    return builder.take_root();
}

void forget_places(JsonValue& value) {
    value.at = {0, 0};
    for (JsonValue& item : value.items) forget_places(item);
    for (JsonMember& member : value.members) {
        member.at = {0, 0};
        forget_places(member.value);
    }
}

void name_parts(JsonValue& document) {
    forget_places(document);
    for (JsonMember& member : document.members)
        member.value.names_items = member.value.type == JsonType::array;
}

std::string item_step(const JsonValue& list, size_t index) {
    const auto& members = list.items[index].members;
    const auto name = std::ranges::find(members, "name", &JsonMember::key);
    if (!list.names_items || name == members.end() || name->value.text.empty())
        return fmt::format("[{}]", index);
    const std::string& text = name->value.text;
    return "." + (text.find_first_of(".[") == text.npos ? text : quote(text));
}

}  // namespace voxelume
