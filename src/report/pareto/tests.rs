//! Points, fronts and the file, over made-up runs.
