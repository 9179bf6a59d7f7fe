//! `virtwall run --live`: serves a page that shows runs while they are under way.

use std::io::{IsTerminal, stdin};
use std::net::{IpAddr, SocketAddr};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use clap::Args;
use lab::{Feed, News, Plan};
use live::{Board, Site, serve};

use crate::exit::{Exit, print_note};

/// How long viewers have to fetch the report if standard input is not a terminal.
const PATIENCE: Duration = Duration::from_secs(5);

#[derive(Args)]
pub struct Serving {
    /// Serve a page that shows the runs while they are under way, on this port of 127.0.0.1
    /// [default: a free port]. When all runs have ended, the page becomes the report
    #[arg(long, value_name = "PORT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "0")]
    live: Option<u16>,
    /// Serve at this address of this host; everyone who can reach it can see the page
    #[arg(long, value_name = "ADDRESS", requires = "live", default_value = "127.0.0.1")]
    live_address: IpAddr,
}

pub struct Live {
    board: Arc<Board>,
    page: Arc<Page>,
    url: String,
}

struct Page {
    html: Mutex<Arc<str>>,
    blocks: lab::LivePage,
}

impl Site for Page {
    fn page(&self) -> Arc<str> {
        Arc::clone(&self.html.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn file(&self, name: &str) -> Option<String> {
        self.blocks.block(name)
    }
}

impl Serving {
    pub fn asked(&self) -> bool {
        self.live.is_some()
    }

    /// Begins to serve a plan's page, if that is asked for.
    pub fn start(&self, plan: &Plan) -> Result<Option<Live>, Exit> {
        let Some(port) = self.live else { return Ok(None) };
        let (html, blocks) = lab::live_page(plan, "updates");
        let page = Arc::new(Page { html: Mutex::new(html.into()), blocks });
        let board = Arc::new(Board::default());
        let address = SocketAddr::new(self.live_address, port);
        let bound =
            serve(address, Arc::clone(&page) as Arc<dyn Site>, &board).map_err(|error| {
                Exit::bad_input(format!("--live: cannot listen at {address}: {error}"))
            })?;
        let url = format!("http://{bound}/");
        print_note(&format!("Live at {url}"));
        Ok(Some(Live { board, page, url }))
    }
}

impl Live {
    /// Receives the parts of runs.
    pub fn feed(&self) -> Feed {
        let board = Arc::clone(&self.board);
        Arc::new(move |run, news| match news {
            News::Part(part) => board.add(run, part),
            News::End => board.end(run),
        })
    }

    /// All runs have ended, and their report is in this folder. On a terminal it is served until Enter is
    /// pressed, else until every viewer has fetched it, at most [`PATIENCE`].
    pub fn finish(&self, out: &Path) {
        if let Ok(report) = std::fs::read_to_string(out.join("report.html")) {
            *self.page.html.lock().unwrap_or_else(PoisonError::into_inner) = report.into();
        }
        let viewers = self.board.viewers();
        self.board.finish();
        if stdin().is_terminal() {
            print_note(&format!("The report is at {} until you press Enter.", self.url));
            // The end of standard input counts as Enter.
            let _ = stdin().read_line(&mut String::new());
        } else if viewers > 0 {
            let seconds = PATIENCE.as_secs();
            print_note(&format!(
                "Waiting up to {seconds} s for {viewers} viewers to fetch the report from {}",
                self.url
            ));
            self.board.wait_for_viewers(PATIENCE);
        }
    }
}
