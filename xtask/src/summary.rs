//! What the suites' outputs say, and the table that ends a test run.

use std::time::Duration;

/// How a suite prints its counts.
#[derive(Clone, Copy)]
pub enum Dialect {
    /// It passes or fails as a whole and counts as one.
    Whole,
    /// `test result: ok. 12 passed; 0 failed; …`, once a binary.
    Cargo,
    /// `# pass 3`, `# fail 0`.
    Node,
    /// `  8 passed (12.3s)`, `  1 failed`, `  1 flaky`, `  2 did not run`.
    Playwright,
}

/// What became of a suite.
pub struct Row {
    pub name: &'static str,
    pub passed: usize,
    pub failed: usize,
    pub time: Duration,
    pub note: String,
}

/// `(passed, failed)` of a suite that printed `output`. A suite that failed without naming a failed test (it did not
/// compile, or crashed) has failed once; one that succeeded without having run anything has too.
pub fn count(dialect: Dialect, output: &str, success: bool) -> (usize, usize) {
    let (passed, failed) = match dialect {
        Dialect::Whole => (usize::from(success), usize::from(!success)),
        Dialect::Cargo => output
            .lines()
            .filter(|line| line.trim_start().starts_with("test result:"))
            .fold((0, 0), |(p, f), line| (p + before(line, "passed"), f + before(line, "failed"))),
        Dialect::Node => (after(output, "pass"), after(output, "fail")),
        Dialect::Playwright => {
            let lines = || output.lines().filter(|line| line.starts_with("  "));
            let sum = |word| lines().map(|line| before(line, word)).sum::<usize>();
            let missing: usize = ["failed", "did not run", "interrupted"].into_iter().map(sum).sum();
            (sum("passed") + sum("flaky"), missing)
        }
    };
    let silent = failed == 0 && (!success || passed == 0);
    (passed, failed + usize::from(silent))
}

/// The number that stands before `word`, where a count is all that precedes it; 0 if there is none.
fn before(line: &str, word: &str) -> usize {
    line.split(['.', ';', '('])
        .find_map(|part| part.trim().strip_suffix(word)?.trim().parse().ok())
        .unwrap_or(0)
}

/// The number in the line `# word N` or `ℹ word N`; 0 if there is none.
fn after(output: &str, word: &str) -> usize {
    output
        .lines()
        .map(str::split_whitespace)
        .map(|mut words| match (words.next(), words.next(), words.next()) {
            (Some("#" | "ℹ"), Some(w), Some(n)) if w == word => n.parse().unwrap_or(0),
            _ => 0,
        })
        .sum()
}

/// The table of all suites; its last line is `N passed, N failed`.
pub fn table(rows: &[Row]) -> String {
    let mut text = format!("\n{:<44} {:>7} {:>7} {:>8}\n", "suite", "passed", "failed", "seconds");
    for row in rows {
        let seconds = row.time.as_secs_f64();
        text += &format!("{:<44} {:>7} {:>7} {seconds:>8.1}\n", row.name, row.passed, row.failed);
        for line in row.note.lines() {
            text += &format!("  {line}\n");
        }
    }
    let sum = |f: fn(&Row) -> usize| rows.iter().map(f).sum::<usize>();
    text + &format!("\n{} passed, {} failed\n", sum(|r| r.passed), sum(|r| r.failed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read_from_each_dialect() {
        let cargo = "test a ... ok\n\ntest result: ok. 12 passed; 0 failed; 0 ignored; finished in 0.1s\n\
                     test result: FAILED. 3 passed; 2 failed; 0 ignored\n";
        assert_eq!(count(Dialect::Cargo, cargo, false), (15, 2));
        assert_eq!(count(Dialect::Node, "# tests 3\n# pass 3\n# fail 0\n", true), (3, 0));
        assert_eq!(count(Dialect::Node, "ℹ pass 2\nℹ fail 1\n", false), (2, 1));
        let browser = "  1 failed\n    a.spec.js:3:1 › b\n  1 flaky\n  2 did not run\n  8 passed (12.3s)\n";
        assert_eq!(count(Dialect::Playwright, browser, false), (9, 3));
        assert_eq!(count(Dialect::Whole, "", true), (1, 0));
    }

    #[test]
    fn failing_silently_is_failing() {
        assert_eq!(count(Dialect::Cargo, "error: could not compile", false), (0, 1));
        assert_eq!(count(Dialect::Cargo, "test result: ok. 4 passed; 0 failed", false), (4, 1));
        assert_eq!(count(Dialect::Playwright, "Error: no tests found", true), (0, 1));
    }

    #[test]
    fn last_line_is_the_sum() {
        let row = |passed, failed| Row {
            name: "some",
            passed,
            failed,
            time: Duration::from_secs(1),
            note: String::new(),
        };
        assert!(table(&[row(3, 0), row(4, 1)]).ends_with("\n7 passed, 1 failed\n"));
    }
}
