#pragma once

#include "sim/base/column_reader.h"
#include "ui/base/json_value.h"
#include "ui/report/frame_record.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// The header line of frames.csv with its line end.
std::string frame_csv_header();

/// One line of frames.csv with its line end: fixed decimals a column, C locale. What is not finite is an empty field;
/// resolution_c, stress, error_px, eye and aircraft places may be that.
std::string frame_csv_line(const FrameRecord& record);

/// The JSON schema of a row of frames.csv: every column by its name.
base::JsonValue frame_schema();

/// The record with its numbers rounded as its line gives them, so that figures computed now and figures computed from
/// the file are the same bit for bit.
FrameRecord rounded_as_csv(const FrameRecord& record);

/// Reads frames.csv row by row. Columns may be in any order, unknown ones are ignored. The columns that recordings of
/// all versions have (marked in frame_csv.cpp) and those of `required_columns` must be there. An empty file has no
/// rows. Frame numbers must increase. Throws Error "file:line: expected ..., got ..." for anything else.
class FrameReader {
public:
    explicit FrameReader(const std::filesystem::path& path, std::span<const std::string_view> required_columns = {});

    /// The next row, nothing at the end.
    std::optional<FrameRecord> next();

    /// After the last row: the last line was cut short (the program was killed) and left out.
    bool is_truncated() const { return is_truncated_; }

private:
    ColumnReader table_;
    std::optional<int> last_frame_;
    bool is_truncated_ = false;
    bool ended_ = false;
};

/// What a frames.csv holds.
struct FrameFile {
    std::vector<FrameRecord> records;
    bool is_truncated = false; ///< the last line was cut short (the program was killed) and left out
};

/// All rows at once, as FrameReader has them; record i stands in line i + 2.
FrameFile read_frame_csv(const std::filesystem::path& path, std::span<const std::string_view> required_columns = {});

} // namespace octant::ui::report
