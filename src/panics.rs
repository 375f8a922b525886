//! Panics of work that may panic, caught and told as text.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether a panic of this thread is caught, and prints nothing.
    static IS_CAUGHT: Cell<bool> = const { Cell::new(false) };
    /// Where the last one happened.
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// A panic that was caught.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Panic {
    /// Its message.
    pub(crate) text: String,
    /// File and line; `None` where another thread panicked on behalf of this one.
    pub(crate) place: Option<String>,
}

/// What `work` gives, or its panic, which prints nothing: a progress bar may be on the terminal.
pub(crate) fn catch<T>(work: impl FnOnce() -> T) -> Result<T, Panic> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if IS_CAUGHT.get() {
                PLACE.set(info.location().map(ToString::to_string));
            } else {
                usual(info);
            }
        }));
    });
    let before = IS_CAUGHT.replace(true);
    PLACE.take();
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    IS_CAUGHT.set(before);
    result.map_err(|payload| Panic {
        text: text_of(&*payload),
        place: PLACE.take(),
    })
}

fn text_of(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
    let text = text.unwrap_or("no message");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_told_with_its_place() {
        assert_eq!(catch(|| 7), Ok(7));
        let found = catch::<()>(|| panic!("no room for\n {}", "this")).unwrap_err();
        assert_eq!(found.text, "no room for this");
        let place = found.place.unwrap();
        assert!(place.starts_with("src/panics.rs:"), "{place}");
    }

    #[test]
    fn one_catch_may_stand_within_another() {
        let found = catch(|| {
            let inner = catch::<()>(|| panic!("inner")).unwrap_err();
            assert_eq!(inner.text, "inner");
            panic!("outer")
        });
        let found: Panic = match found {
            Ok(()) => panic!("it panics"),
            Err(found) => found,
        };
        assert_eq!(found.text, "outer");
    }
}
