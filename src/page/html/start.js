// Begins with what the program has written into the page.

const pageData = JSON.parse(showEscapes(byId('data').textContent));
const page = new Page(readRuns(pageData), pageData.properties ?? null);
if (pageData.live !== undefined) page.follow(pageData.live);
