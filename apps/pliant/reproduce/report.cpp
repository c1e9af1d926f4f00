#include "report.hpp"

#include <fstream>
#include <iterator>

#include "comparison_table.hpp"
#include "embedded_texts.hpp"
#include "files/atomic_file.hpp"
#include "pliant/version.hpp"

namespace pliant::tool::reproduce {
namespace {

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string base64(const std::string& bytes)
{
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8 | (k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0u);
        for (std::size_t i = 0; i < 4; ++i)
            text += k + i <= bytes.size() ? digits[group >> (18 - 6 * i) & 63] : '=';
    }
    return text;
}

/// Writes the elements of a report in one kind of document.
class Format {
public:
    virtual ~Format() = default;
    virtual std::string escaped(const std::string& text) const = 0;
    virtual void heading(int level, const std::string& text, const std::string& id) = 0;
    virtual void paragraph(const std::string& label, const std::string& text) = 0;
    virtual void list(const std::vector<std::string>& items) = 0;
    virtual void links(const std::vector<std::pair<std::string, std::string>>& names_and_ids) = 0;
    virtual void table(const std::vector<std::string>& head, const std::vector<std::string>& sources,
                       const Json& rows) = 0;
    virtual void figure(const std::string& id) = 0;
    virtual void pictures(const Json& pictures) = 0;
    virtual void commands(const Json& commands) = 0;
    virtual std::string finished() = 0;
};

class Markdown : public Format {
public:
    std::string escaped(const std::string& text) const override
    {
        std::string safe;
        for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
        return safe;
    }
    void heading(int level, const std::string& text, const std::string&) override
    {
        text_ += std::string(static_cast<std::size_t>(level), '#') + " " + text + "\n\n";
    }
    void paragraph(const std::string& label, const std::string& text) override
    {
        text_ += (label.empty() ? "" : "**" + label + "** ") + text + "\n\n";
    }
    void list(const std::vector<std::string>& items) override
    {
        for (const std::string& item : items) text_ += "- " + item + "\n";
        if (!items.empty()) text_ += "\n";
    }
    void links(const std::vector<std::pair<std::string, std::string>>&) override {}
    void table(const std::vector<std::string>& head, const std::vector<std::string>&,
               const Json& rows) override
    {
        line(head);
        line(std::vector<std::string>(head.size(), "---"));
        for (const Json& row : rows) {
            std::vector<std::string> cells;
            for (const std::string cell : row) cells.push_back(escaped(cell));
            line(cells);
        }
        text_ += "\n";
    }
    void figure(const std::string& id) override { text_ += "![" + id + "](figures/" + id + ".svg)\n\n"; }
    void pictures(const Json& pictures) override
    {
        for (const Json& picture : pictures)
            text_ += "![" + picture["caption"].get<std::string>() + "](pictures/" +
                     picture["file"].get<std::string>() + " \"" + picture["caption"].get<std::string>() +
                     "\")\n";
        if (!pictures.empty()) text_ += "\n";
    }
    void commands(const Json& commands) override
    {
        text_ += "<details><summary>The same by hand</summary>\n\n";
        for (const std::string command : commands) text_ += "    " + command + "\n";
        text_ += "\n</details>\n\n";
    }
    std::string finished() override { return text_; }

private:
    void line(const std::vector<std::string>& cells)
    {
        for (const std::string& cell : cells) text_ += "| " + cell + " ";
        text_ += "|\n";
    }
    std::string text_;
};

class Html : public Format {
public:
    explicit Html(std::filesystem::path out) : out_(std::move(out)) {}
    std::string escaped(const std::string& text) const override
    {
        std::string safe;
        for (const char c : text)
            safe += c == '&'   ? "&amp;"
                    : c == '<' ? "&lt;"
                    : c == '>' ? "&gt;"
                    : c == '"' ? "&quot;"
                               : std::string(1, c);
        return safe;
    }
    void heading(int level, const std::string& text, const std::string& id) override
    {
        const std::string tag = "h" + std::to_string(level);
        text_ +=
            "<" + tag + (id.empty() ? "" : " id=\"" + id + "\"") + ">" + escaped(text) + "</" + tag + ">\n";
    }
    void paragraph(const std::string& label, const std::string& text) override
    {
        text_ += "<p>" + (label.empty() ? "" : "<b>" + escaped(label) + "</b> ") + escaped(text) + "</p>\n";
    }
    void list(const std::vector<std::string>& items) override
    {
        if (items.empty()) return;
        text_ += "<ul>";
        for (const std::string& item : items) text_ += "<li>" + escaped(item) + "</li>";
        text_ += "</ul>\n";
    }
    void links(const std::vector<std::pair<std::string, std::string>>& names_and_ids) override
    {
        text_ += "<nav>";
        for (const auto& [name, id] : names_and_ids)
            text_ += "<a href=\"#" + id + "\">" + escaped(name) + "</a> ";
        text_ += "</nav>\n";
    }
    void table(const std::vector<std::string>& head, const std::vector<std::string>& sources,
               const Json& rows) override
    {
        text_ += "<div class=\"wide\"><table><tr>";
        for (std::size_t c = 0; c < head.size(); ++c)
            text_ += "<th" + class_of(sources[c]) + ">" + escaped(head[c]) + "</th>";
        text_ += "</tr>\n";
        for (const Json& row : rows) {
            text_ += "<tr>";
            for (std::size_t c = 0; c < row.size(); ++c)
                text_ += "<td" + class_of(sources[c], row[c]) + ">" + escaped(row[c]) + "</td>";
            text_ += "</tr>\n";
        }
        text_ += "</table></div>\n";
    }
    void figure(const std::string& id) override
    {
        const std::string svg = text_of(out_ / "figures" / (id + ".svg"));
        const auto at = svg.find("<svg");  // without the XML declaration
        if (at != std::string::npos) text_ += "<figure>" + svg.substr(at) + "</figure>\n";
    }
    void pictures(const Json& pictures) override
    {
        std::string row;
        for (const Json& picture : pictures) {
            if (row != picture["case"]) {
                if (!row.empty()) text_ += "</div>\n";
                row = picture["case"];
                text_ += "<div class=\"pictures\">";
            }
            const std::string caption = escaped(picture["caption"]);
            text_ += "<figure><img alt=\"" + caption + "\" src=\"data:image/png;base64," +
                     base64(text_of(out_ / "pictures" / picture["file"].get<std::string>())) +
                     "\"><figcaption>" + caption + "</figcaption></figure>";
        }
        if (!row.empty()) text_ += "</div>\n";
    }
    void commands(const Json& commands) override
    {
        text_ += "<details><summary>The same by hand</summary><pre>";
        for (const std::string command : commands) text_ += escaped(command) + "\n";
        text_ += "</pre></details>\n";
    }
    std::string finished() override
    {
        return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
               "<meta name=\"viewport\" content=\"width=device-width\"><title>Pliant: the papers, "
               "reproduced</title>\n<style>\n" +
               std::string(text_style) + "</style></head>\n<body>\n" + text_ + "</body></html>\n";
    }

private:
    static std::string class_of(const std::string& source, const std::string& cell = "")
    {
        const bool is_word = !cell.empty() && cell.find_first_of("0123456789") != 0;
        const std::string names = std::string(source == "theirs" ? "theirs " : "") + (is_word ? "word" : "");
        return names.empty() ? "" : " class=\"" + names + "\"";
    }
    std::filesystem::path out_;
    std::string text_;
};

void write_tables(Format& format, const Json& document)
{
    for (const Json& table : document["tables"]) {
        if (table.contains("title")) format.paragraph(table["title"], "");
        std::vector<std::string> head, sources;
        for (const Json& column : table["columns"]) {
            const std::string unit = column["unit"];
            head.push_back(column["title"].get<std::string>() + (unit.empty() ? "" : ", " + unit));
            sources.push_back(column["source"]);
        }
        format.table(head, sources, table["rows"]);
    }
}

std::string devices_of(const Json& document)
{
    std::string text;
    for (const Json& machine : document["machines"]) {
        const std::string title = machine["title"];
        text += (text.empty() ? "" : "; ") + (title == "ours" ? "" : title + ": ") +
                machine["device"].get<std::string>();
    }
    return text;
}

void write_experiment(Format& format, const std::filesystem::path& out, const Json& document)
{
    const std::string id = document["id"];
    format.heading(3, document["item"].get<std::string>() + ": " + document["title"].get<std::string>(), id);
    format.paragraph("Setting.", document["setting"]);
    if (!document["machines"].empty())
        format.paragraph("Theirs:", document["hardware"].get<std::string>() + ". Ours: " +
                                        devices_of(document) + "; " + document["date"].get<std::string>() +
                                        ", pliant " + document["version"].get<std::string>() +
                                        (document["quick"].get<bool>() ? ", quick run." : "."));
    if (std::filesystem::exists(out / "figures" / (id + ".svg"))) format.figure(id);
    write_tables(format, document);
    std::vector<std::string> findings = document["findings"];
    for (const std::string note : document["notes"]) findings.push_back(note);
    format.list(findings);
    format.pictures(document["pictures"]);
    if (!document["theirs"].empty()) {
        Json rows = Json::array();
        for (const Json& number : document["theirs"])
            rows.push_back({number["what"], number_text(number["value"].get<double>()), number["unit"],
                            number["where"]});
        format.paragraph("The paper says:", "");
        format.table({"what", "value", "unit", "where"}, {"theirs", "theirs", "theirs", "theirs"}, rows);
    }
    format.paragraph("What differs, and why.", document["differs"]);
    if (!document["commands"].empty()) format.commands(document["commands"]);
}

void write_all(Format& format, const std::filesystem::path& out, const std::vector<Json>& documents,
               const std::vector<std::string>& notes)
{
    format.heading(1, "The papers, reproduced", "");
    format.paragraph("",
                     std::string("Written by pliant reproduce, version ") + PLIANT_VERSION +
                         ". Numbers of the papers are marked as theirs and were measured on their machine, "
                         "numbers of ours on the one named with each figure: compare ratios, not absolute "
                         "numbers. SI units.");
    format.list(notes);
    std::vector<std::pair<std::string, std::string>> links;
    for (const Json& document : documents)
        links.emplace_back(document["paper"].get<std::string>() + ", " + document["item"].get<std::string>(),
                           document["id"].get<std::string>());
    format.links(links);
    std::string paper;
    for (const Json& document : documents) {
        if (document["paper"] != paper) {
            paper = document["paper"];
            format.heading(2, paper == "cloth" ? "Cloth" : "Volume", "");
            format.paragraph("", papers().at("papers").at(paper).at("citation"));
        }
        write_experiment(format, out, document);
    }
}

/// Every number of every table in one file, one per line.
std::string all_numbers(const std::vector<Json>& documents)
{
    Json list;
    list["columns"] = Json::array();
    for (const char* title : {"experiment", "case", "whose", "quantity", "unit", "value"})
        list["columns"].push_back({{"title", title}, {"unit", ""}});
    list["rows"] = Json::array();
    for (const Json& document : documents)
        for (const Json& table : document["tables"])
            for (const Json& row : table["rows"]) {
                std::string name;
                for (std::size_t c = 0; c < row.size(); ++c) {
                    const Json& column = table["columns"][c];
                    if (column["source"] == "case" && column["name"] == column["title"] &&
                        document["kind"] != "passes") {
                        if (!row[c].get<std::string>().empty())
                            name += (name.empty() ? "" : "; ") + column["title"].get<std::string>() + " " +
                                    row[c].get<std::string>();
                        continue;
                    }
                    if (document["kind"] == "passes" || row[c].get<std::string>().empty()) continue;
                    list["rows"].push_back(
                        {document["id"], name, column["source"], column["title"], column["unit"], row[c]});
                }
            }
    return csv_of(list);
}

}  // namespace

void write_report(const std::filesystem::path& out, const std::vector<Json>& documents,
                  const std::vector<std::string>& notes)
{
    Markdown markdown;
    write_all(markdown, out, documents, notes);
    write_text_file(out / "report.md", markdown.finished());
    Html html(out);
    write_all(html, out, documents, notes);
    write_text_file(out / "report.html", html.finished());
    write_text_file(out / "results.csv", all_numbers(documents));
}

}  // namespace pliant::tool::reproduce
