# ask.fish FOLDER < LINES: what fish offers at the end of each line, by the alphabet.
cd $argv[1]
kbc completion fish | source
while read --local line
    echo "$line:" (complete -C $line | cut -f1 | LC_ALL=C sort)
end
