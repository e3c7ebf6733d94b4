//! A process that is stopped when its time is up.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::XtaskError;

/// How often a running process is looked after: seldom enough not to disturb it.
const PAUSE: Duration = Duration::from_millis(20);

/// How a process ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Ending {
    /// With success; what it printed.
    Succeeded(String),
    /// Without; the line of its complaint that tells most.
    Failed(String),
    /// Stopped when its time was up.
    Stopped,
}

/// Runs `command` for at most `limit`; its output is kept in files beside `log`, which must be in a folder of its own.
///
/// # Errors
/// A program that cannot be started or waited for; a log that cannot be written or read.
pub(super) fn run_within(
    command: &mut Command,
    limit: Duration,
    log: &Path,
) -> Result<Ending, XtaskError> {
    let (printed, complaints) = (log.with_extension("out"), log.with_extension("err"));
    let program = command.get_program().to_owned();
    let unstartable = |source| XtaskError::Start {
        program: program.clone().into(),
        source,
    };
    let mut child = command
        .stdin(Stdio::null())
        .stdout(create(&printed)?)
        .stderr(create(&complaints)?)
        .spawn()
        .map_err(unstartable)?;
    Ok(match wait(&mut child, limit).map_err(unstartable)? {
        None => Ending::Stopped,
        Some(status) if status.success() => Ending::Succeeded(read(&printed)?),
        Some(status) => Ending::Failed(complaint(&read(&complaints)?, status)),
    })
}

/// The status of a process that ends within `limit`; one that does not is killed.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<Option<ExitStatus>> {
    let clock = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if clock.elapsed() >= limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(PAUSE);
    }
}

/// The first line that names a fatal error, else the last that names an error, else the last at all.
fn complaint(text: &str, status: ExitStatus) -> String {
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty());
    let names = |word: &'static str| move |line: &&str| line.to_lowercase().contains(word);
    let telling = lines()
        .find(names("fatal error"))
        .or_else(|| lines().rfind(names("error")))
        .or_else(|| lines().next_back());
    telling.map_or_else(|| status.to_string(), str::to_owned)
}

fn create(path: &Path) -> Result<File, XtaskError> {
    File::create(path).map_err(|source| XtaskError::Write {
        path: path.into(),
        source,
    })
}

fn read(path: &Path) -> Result<String, XtaskError> {
    let bytes = fs::read(path).map_err(|source| XtaskError::Read {
        path: path.into(),
        source,
    })?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;

    fn shell(script: &str, limit: Duration) -> Ending {
        let folder = tempfile::tempdir().unwrap();
        let mut command = Command::new("sh");
        run_within(
            command.args(["-c", script]),
            limit,
            &folder.path().join("log"),
        )
        .unwrap()
    }

    const LONG: Duration = Duration::from_mins(1);

    #[test]
    fn a_process_that_succeeds_returns_what_it_printed() {
        assert_eq!(shell("echo yes", LONG), Ending::Succeeded("yes\n".into()));
    }

    #[test]
    fn a_process_that_fails_returns_the_line_that_tells_most() {
        let script = "echo 'x.h: fatal error: no such file' >&2; echo 'Error: see above' >&2; echo bye >&2; exit 3";
        let complaint = "x.h: fatal error: no such file".to_owned();
        assert_eq!(shell(script, LONG), Ending::Failed(complaint));
        let script = "echo 'ValueError: 7' >&2; echo >&2; exit 3";
        assert_eq!(shell(script, LONG), Ending::Failed("ValueError: 7".into()));
        assert_eq!(
            shell("exit 3", LONG),
            Ending::Failed("exit status: 3".into())
        );
    }

    #[test]
    fn a_process_that_takes_too_long_is_stopped() {
        let clock = Instant::now();
        assert_eq!(shell("sleep 50", 2 * PAUSE), Ending::Stopped);
        assert!(clock.elapsed() < LONG / 2);
    }

    #[test]
    fn a_program_that_is_not_there_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let mut command = Command::new(folder.path().join("nothing"));
        let started = run_within(&mut command, LONG, &folder.path().join("log"));
        assert!(matches!(started, Err(XtaskError::Start { .. })));
    }
}
