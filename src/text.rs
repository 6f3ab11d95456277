//! Text of strangers (names, paths, what stands in a file) as a message may show it: without what a terminal would
//! obey.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::fmt::Write;

/// A text in which nothing acts: control characters, and those that turn the direction of writing or start a new line,
/// are written as Rust writes them, `\n` or `\u{1b}`.
pub fn escaped(text: &str) -> Cow<'_, str> {
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        // Writing to a string cannot fail.
        let _ = if acts(c) { write!(plain, "{}", c.escape_default()) } else { write!(plain, "{c}") };
    }
    Cow::Owned(plain)
}

/// Lines in which nothing but the ends of lines acts.
pub fn escaped_lines(text: &str) -> String {
    text.split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}

/// A path or a name that need not be text: what is no UTF-8 is shown as �.
pub fn named(name: impl AsRef<OsStr>) -> String {
    escaped(&name.as_ref().to_string_lossy()).into_owned()
}

fn acts(c: char) -> bool {
    // Of the Unicode Bidirectional Algorithm (UAX #9), line and paragraph separator, and the mark of a byte order.
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_spelled_out() {
        assert_eq!(escaped("red \u{1b}[31m\u{7}\u{9b}2J"), "red \\u{1b}[31m\\u{7}\\u{9b}2J");
        assert_eq!(escaped("a\r\nb\tc\u{7f}"), "a\\r\\nb\\tc\\u{7f}");
        assert_eq!(escaped("\u{202e}nor.enecs"), "\\u{202e}nor.enecs");
        assert_eq!(escaped_lines("a\u{1b}\nb"), "a\\u{1b}\nb");
    }

    #[test]
    fn text_that_only_says_something_stays_as_it_is() {
        for text in ["Newton’s cradle – 1.5 µm", "鎖 \"a\" \\n 'b'", "🙂"] {
            assert!(matches!(escaped(text), Cow::Borrowed(same) if same == text));
        }
    }

    #[test]
    #[cfg(unix)]
    fn a_name_need_not_be_text() {
        use std::os::unix::ffi::OsStrExt;
        assert_eq!(named(OsStr::from_bytes(b"a\xff\x1b.ron")), "a\u{fffd}\\u{1b}.ron");
    }
}
