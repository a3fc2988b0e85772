//! Turns a panic inside naga into a diagnostic.
//!
//! naga 30.0.1 is written for wgpu, which checks much before it calls a writer; called alone, its front ends and writers
//! still hold `unreachable!` and `unimplemented!` arms. The ones that valid input can reach are refused beforehand by
//! [`crate::emit`]'s support tables; this guard is for the ones nobody has found yet.
//!
//! While a guarded call runs, the process's panic hook prints nothing for this thread; every other panic goes to the hook
//! that was there before.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

use crate::diagnostic::{Code, Diagnostic};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

static HOOK: Once = Once::new();

fn install_hook() {
    HOOK.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |info| {
            if !GUARDED.get() {
                before(info);
            }
        }));
    });
}

/// Runs `work`; a panic becomes an error that says what was going on.
pub(crate) fn guard<T>(
    file: &str,
    doing: &str,
    work: impl FnOnce() -> Result<T, Diagnostic>,
) -> Result<T, Diagnostic> {
    install_hook();
    let outer = GUARDED.replace(true);
    let result = catch_unwind(AssertUnwindSafe(work));
    GUARDED.set(outer);
    result.unwrap_or_else(|payload| {
        let said = payload
            .downcast_ref::<String>()
            .map(String::as_str)
            .or_else(|| payload.downcast_ref::<&str>().copied())
            .unwrap_or("no message");
        Err(
            Diagnostic::new(Code::Internal, format!("naga failed while {doing}: {said}"))
                .in_file(file)
                .with_hint(
                    "this is a fault of the translator, not of the shader; please report it with the shader",
                ),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_diagnostic() {
        let result: Result<(), _> = guard("a.wgsl", "testing", || panic!("boom {}", 1));
        let diagnostic = result.unwrap_err();
        assert_eq!(diagnostic.code, Code::Internal);
        assert_eq!(diagnostic.message, "naga failed while testing: boom 1");
    }

    #[test]
    fn results_pass_through() {
        assert_eq!(guard("a", "testing", || Ok(7)).unwrap(), 7);
        let refused = guard("a", "testing", || {
            Err::<(), _>(Diagnostic::new(Code::Parse, "no"))
        });
        assert_eq!(refused.unwrap_err().code, Code::Parse);
        assert!(!GUARDED.get());
    }
}
