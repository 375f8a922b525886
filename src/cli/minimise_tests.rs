use super::*;

#[test]
fn words_for_a_shell() {
    assert_eq!(shell_word("a/b_c.toml"), "a/b_c.toml");
    assert_eq!(shell_word("it's a b"), "'it'\\''s a b'");
    assert_eq!(shell_word(""), "''");
}
