//! Finds where a part of a document stands in its text.
//!
//! The text has been read as RON before, so this scanner need not understand it: it only skips what it is not asked for.

use super::error::Step;

/// Byte offset of the part of `text` at the end of `path`, or of the nearest part around it that is written there.
pub(crate) fn locate(text: &str, path: &[Step]) -> usize {
    let mut scanner = Scanner { text: text.as_bytes(), at: 0 };
    scanner.skip_attributes();
    for step in path {
        let parent = scanner.at;
        let found = match step {
            Step::Field(name) => scanner.enter_field(name),
            Step::Index(index) => scanner.enter_element(*index),
        };
        if !found {
            return parent;
        }
    }
    scanner.at
}

/// Line and column, from 1, of a byte offset; the column counts characters.
pub(crate) fn line_and_column(text: &str, offset: usize) -> [usize; 2] {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
    // Continuation bytes of UTF-8 begin with the bits 10.
    let column = 1 + before[start..].iter().filter(|&&byte| byte & 0xc0 != 0x80).count();
    [line, column]
}

struct Scanner<'a> {
    text: &'a [u8],
    at: usize,
}

impl Scanner<'_> {
    fn peek(&self) -> u8 {
        self.text.get(self.at).copied().unwrap_or(0)
    }

    fn starts_with(&self, prefix: &str) -> bool {
        self.text[self.at.min(self.text.len())..].starts_with(prefix.as_bytes())
    }

    fn at_end(&self) -> bool {
        self.at >= self.text.len()
    }

    /// Skips white space and comments, nested ones included.
    fn skip_blanks(&mut self) {
        loop {
            if self.peek().is_ascii_whitespace() {
                self.at += 1;
            } else if self.starts_with("//") {
                while !self.at_end() && self.peek() != b'\n' {
                    self.at += 1;
                }
            } else if self.starts_with("/*") {
                self.skip_block_comment();
            } else {
                return;
            }
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        while !self.at_end() {
            if self.starts_with("/*") {
                depth += 1;
                self.at += 2;
            } else if self.starts_with("*/") {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    return;
                }
            } else {
                self.at += 1;
            }
        }
    }

    /// Skips `#![enable(…)]` lines and the blanks around them.
    fn skip_attributes(&mut self) {
        self.skip_blanks();
        while self.starts_with("#!") {
            while !self.at_end() && self.peek() != b']' {
                self.at += 1;
            }
            self.at += 1;
            self.skip_blanks();
        }
    }

    fn identifier(&mut self) -> &[u8] {
        if self.starts_with("r#") {
            self.at += 2;
        }
        let start = self.at.min(self.text.len());
        while self.peek().is_ascii_alphanumeric() || self.peek() == b'_' || self.peek() >= 0x80 {
            self.at += 1;
        }
        &self.text[start..self.at.min(self.text.len())]
    }

    /// Steps over the name of a record and its opening bracket (and through `Some(`).
    fn open(&mut self) -> bool {
        loop {
            let optional = self.identifier() == b"Some";
            self.skip_blanks();
            if !matches!(self.peek(), b'(' | b'[') {
                return false;
            }
            self.at += 1;
            self.skip_blanks();
            if !optional {
                return true;
            }
        }
    }

    /// Moves to the value of field `name` of the record at hand.
    fn enter_field(&mut self, name: &str) -> bool {
        if !self.open() {
            return false;
        }
        while !self.at_end() && self.peek() != b')' {
            let found = self.identifier() == name.as_bytes();
            self.skip_blanks();
            if self.peek() != b':' {
                return false;
            }
            self.at += 1;
            self.skip_blanks();
            if found {
                return true;
            }
            self.skip_entry();
        }
        false
    }

    /// Moves to element `index` of the list at hand.
    fn enter_element(&mut self, index: usize) -> bool {
        if !self.open() {
            return false;
        }
        for _ in 0..index {
            self.skip_entry();
        }
        !self.at_end() && !matches!(self.peek(), b']' | b')')
    }

    /// Skips the value at hand, the comma after it and the blanks after that.
    fn skip_entry(&mut self) {
        let mut depth = 0_usize;
        while !self.at_end() {
            match self.peek() {
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' if depth == 0 => return,
                b')' | b']' | b'}' => depth -= 1,
                b',' if depth == 0 => {
                    self.at += 1;
                    self.skip_blanks();
                    return;
                }
                b'"' => {
                    self.skip_string();
                    continue;
                }
                b'r' if self.starts_with("r\"") || self.starts_with("r#") => {
                    self.skip_raw();
                    continue;
                }
                b'/' => {
                    let before = self.at;
                    self.skip_blanks();
                    if self.at > before {
                        continue;
                    }
                }
                byte if byte.is_ascii_alphanumeric() || byte == b'_' => {
                    self.identifier();
                    continue;
                }
                _ => {}
            }
            self.at += 1;
        }
    }

    fn skip_string(&mut self) {
        self.at += 1;
        while !self.at_end() && self.peek() != b'"' {
            self.at += if self.peek() == b'\\' { 2 } else { 1 };
        }
        self.at += 1;
    }

    /// Skips a raw string `r#"…"#`, or a raw identifier `r#name`.
    fn skip_raw(&mut self) {
        self.at += 1;
        let hashes = self.text[self.at..].iter().take_while(|&&byte| byte == b'#').count();
        self.at += hashes;
        if self.peek() != b'"' {
            return;
        }
        self.at += 1;
        let close = format!("\"{}", "#".repeat(hashes));
        while !self.at_end() && !self.starts_with(&close) {
            self.at += 1;
        }
        self.at += close.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r##"#![enable(implicit_some)]
// bodies: [first comment]
(
    title: "a (tricky, [one \" ", /* nested /* , */ */
    about: r#"raw ", ("#,
    view: Some((centre: (0, 1), height: 8)),
    bodies: [Disc(mass: 1), Disc(position: (1, 2), mass: 2), Disc(radius: 3)],
)"##;

    fn found(path: &[Step]) -> &'static str {
        &TEXT[locate(TEXT, path)..]
    }

    #[test]
    fn parts_are_found_behind_strings_comments_and_options() {
        use Step::{Field, Index};
        assert!(found(&[Field("about")]).starts_with("r#\"raw"));
        assert!(found(&[Field("view"), Field("height")]).starts_with("8)"));
        assert!(found(&[Field("bodies"), Index(1), Field("mass")]).starts_with("2)"));
        assert!(found(&[Field("bodies"), Index(1), Field("position"), Index(1)]).starts_with("2),"));
    }

    #[test]
    fn a_part_that_is_not_written_is_found_at_what_holds_it() {
        use Step::{Field, Index};
        assert!(found(&[Field("bodies"), Index(2), Field("mass")]).starts_with("Disc(radius"));
        assert!(found(&[Field("walls"), Index(7)]).starts_with("(\n"));
    }

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        assert_eq!(line_and_column("ab\ncé d", 7), [2, 4]);
        assert_eq!(line_and_column("", 0), [1, 1]);
    }
}
